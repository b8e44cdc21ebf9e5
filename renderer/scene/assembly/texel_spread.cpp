// Adds variances texel by texel, in the form that the material's width has: roughness beside metalness, or parameters.
#include "renderer/scene/assembly/texel_spread.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renderer/core/error.hpp"
#include "renderer/scene/assembly/surface_maps.hpp"

namespace footprint {
namespace {

void require_one_grid(const TextureMap& kappa, const Material& material) {
  constexpr const char* place = "[maps] normal_kappa";
  if (!material.lobes.empty()) {
    throw Error(ErrorKind::usage, place, fmt::format("`{}` has several lobes per facet", material.name),
                "leave the map out, or give the material one lobe");
  }
  if (material.anisotropy && material.anisotropy->strength > 0.0F) {
    throw Error(ErrorKind::usage, place, fmt::format("`{}` is anisotropic", material.name),
                "leave the map out, or give anisotropy = 0 in [brdf]");
  }
  if (const TextureMap* const width = width_map(material);
      width != nullptr && width->coordinates != kappa.coordinates) {
    throw Error(ErrorKind::usage, place,
                fmt::format("`{}` has a map of lobe widths with other texture coordinates", material.name),
                "give both maps the same `uv`");
  }
}

Lobe lobe_at(const Material& material, float width) {
  const NormalDistribution distribution = material.brdf.distribution;
  return material.lobe_parameter_map ? Lobe{distribution, width} : lobe_from_alpha(distribution, width * width);
}

}  // namespace

Lobe convolved(const Lobe& base, double kappa) {
  const double own = base.parameter;
  switch (base.distribution) {
    case NormalDistribution::blinn_phong:
    case NormalDistribution::vmf:
      return {base.distribution, kappa * own / (kappa + own)};
    case NormalDistribution::beckmann:
    case NormalDistribution::ggx:
      break;
  }
  const double alpha = std::sqrt(own * own + 2.0 / kappa);
  return {base.distribution, base.distribution == NormalDistribution::ggx ? std::min(alpha, 1.0) : alpha};
}

void spread_normals(const TextureMap& kappa, Material& material) {
  require_one_grid(kappa, material);
  const TextureMap* const width = width_map(material);
  const Image spreads = kappa.image.decoded(), widths = width != nullptr ? width->image.decoded() : Image(1, 1, 1);
  const bool beside_metalness = metallic_map(material) != nullptr;
  Image out(std::max(spreads.width, widths.width), std::max(spreads.height, widths.height), beside_metalness ? 2 : 1);
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const auto own = texel_under(widths, x, y, out.width, out.height);
      const Lobe base = width != nullptr ? lobe_at(material, own[0]) : lobe_of(material);
      const Lobe lobe = convolved(base, texel_under(spreads, x, y, out.width, out.height)[0]);
      out.at(x, y)[0] = beside_metalness ? lobe_roughness(lobe) : static_cast<float>(lobe.parameter);
      if (beside_metalness) out.at(x, y)[1] = own[1];
    }
  }
  std::optional<TextureMap>& map = beside_metalness ? material.metallic_roughness_map : material.lobe_parameter_map;
  map = TextureMap{kappa.name, MapTexels::packed(out), kappa.coordinates};
  material.lobe_parameter.reset();
}

}  // namespace footprint
