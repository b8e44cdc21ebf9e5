// A material on the GPU: any method's distribution of normals, and the sum over texels.
#pragma once

#include "renderer/bake/baked_method.hpp"
#include "renderer/gl/context.hpp"
#include "renderer/ndf/reference_ndf.hpp"
#include "renderer/pipeline/gpu_scene.hpp"
#include "tests/hard_cases/hard_case.hpp"

namespace footprint::hard_cases {

/// Directions, and the sum over texels at each.
struct Directions {
  HemisphereGrid grid;  ///< without solid angles if the directions are only near the facets' normals
  std::vector<double> exact;
};

class NdfBench {
 public:
  NdfBench(const gl::Context& context, const Material& material, const FootprintRect& footprint);

  /// A grid over the hemisphere of at most `rings` rings; fewer if the narrowest lobe needs fewer.
  [[nodiscard]] Directions over_the_hemisphere(int rings) const;
  /// Facets' normals, and directions 0.7, 1.5, 3 and 8 widths of the narrowest lobe away from them.
  [[nodiscard]] Directions about_the_facets() const;
  /// The pixels of a size x size image of the disc.
  [[nodiscard]] Directions over_the_disc(int size) const;

  [[nodiscard]] std::vector<float> densities(const MethodSpec& spec, const Directions& directions);

 private:
  [[nodiscard]] std::vector<double> exact_at(const std::vector<glm::vec3>& directions) const;

  const gl::Context* context_;
  FootprintRect footprint_;
  Scene scene_;
  EffectSet effects_;
  GpuScene gpu_;
  FootprintTexels texels_;
};

}  // namespace footprint::hard_cases
