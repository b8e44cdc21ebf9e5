// One material on the GPU: any method's distribution of normals beside the sum over texels.
#pragma once

#include "renderer/bake/baked_method.hpp"
#include "renderer/gl/context.hpp"
#include "renderer/ndf/hemisphere_grid.hpp"
#include "renderer/pipeline/gpu_scene.hpp"
#include "stability/hard_case.hpp"

namespace footprint::stability {

/// What is looked at, and the sum there.
struct Directions {
  HemisphereGrid grid;  ///< solid angles are empty where the directions are some near the facets' normals
  std::vector<double> truth;
};

class NdfBench {
 public:
  NdfBench(const gl::Context& context, const Material& material, const FootprintRect& footprint);

  /// `rings` over the hemisphere, at most; fewer where the narrowest lobe needs fewer.
  [[nodiscard]] Directions over_the_hemisphere(int rings) const;
  /// At facets' normals, and 0.7, 1.5, 3 and 8 widths of the narrowest lobe away from them.
  [[nodiscard]] Directions about_the_facets() const;
  /// The pixels of a picture of the disc.
  [[nodiscard]] Directions over_the_disc(int size) const;

  [[nodiscard]] std::vector<float> densities(const MethodSpec& spec, const Directions& directions);

 private:
  [[nodiscard]] std::vector<double> truth_at(const std::vector<glm::vec3>& directions) const;

  const gl::Context* context_;
  FootprintRect footprint_;
  Scene scene_;
  EffectSet effects_;
  GpuScene gpu_;
  FootprintTexels texels_;
};

}  // namespace footprint::stability
