// Uses the NDF inspector without its files.
#include "tests/hard_cases/ndf_bench.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "methods/registry.hpp"
#include "renderer/ndf/method_ndf.hpp"
#include "renderer/ndf/reference_ndf.hpp"

namespace footprint::hard_cases {

NdfBench::NdfBench(const gl::Context& context, const Material& material, const FootprintRect& footprint)
    : context_(&context),
      footprint_(footprint),
      scene_(scene_of_facets(material)),
      effects_(effects_on(derive_effects(scene_))),
      gpu_(context.info(), scene_, effects_),
      texels_(texels_under(material, footprint)) {}

std::vector<double> NdfBench::exact_at(const std::vector<glm::vec3>& directions) const {
  const ReferenceNdf exact(scene_.materials.front().brdf.distribution, texels_.facets);
  return exact.densities(directions, no_progress);
}

Directions NdfBench::over_the_hemisphere(int rings) const {
  const ReferenceNdf exact(scene_.materials.front().brdf.distribution, texels_.facets);
  Directions out{hemisphere_grid(std::min(resolution_for(exact.narrowest()), rings)), {}};
  out.exact = exact.densities(out.grid.directions, no_progress);
  return out;
}

Directions NdfBench::about_the_facets() const {
  constexpr std::size_t most_facets = 4;
  constexpr std::array<double, 4> widths{0.7, 1.5, 3.0, 8.0};
  Directions out;
  const NormalDistribution distribution = scene_.materials.front().brdf.distribution;
  for (std::size_t i = 0; i < std::min(texels_.facets.size(), most_facets); ++i) {
    const WeightedFacet& facet = texels_.facets[i];
    const double width = lobe_width({distribution, facet.parameter});
    const glm::dvec3 across = glm::normalize(glm::cross(facet.normal, glm::dvec3(0.3, 0.9, 0.1)));
    out.grid.directions.emplace_back(facet.normal);
    for (const double away : widths) {
      for (const double side : {-1.0, 1.0})
        out.grid.directions.emplace_back(glm::normalize(facet.normal + side * away * width * across));
    }
  }
  out.exact = exact_at(out.grid.directions);
  return out;
}

Directions NdfBench::over_the_disc(int size) const {
  Directions out;
  out.grid.directions = disc_directions(size);
  out.exact = exact_at(out.grid.directions);
  return out;
}

std::vector<float> NdfBench::densities(const MethodSpec& spec, const Directions& directions) {
  const BakedMethod baked = bake(find_method(spec), spec, scene_, effects_, no_progress);
  const MethodNdf ndf(context_->info(), gpu_, baked, scene_.materials.front(), {FootprintFilterKind::anisotropic, 8});
  std::vector<float> out = ndf.densities(footprint_, directions.grid.directions);
  context_->check("evaluating the NDF of " + spec.text);
  return out;
}

}  // namespace footprint::hard_cases
