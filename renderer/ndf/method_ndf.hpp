// Evaluates the effective NDF of a method with its own shader.
#pragma once

#include <span>
#include <vector>

#include "renderer/gl/context.hpp"
#include "renderer/ndf/footprint_texels.hpp"
#include "renderer/pipeline/surface_program.hpp"

namespace footprint {

/// Creates a scene with one plane for baking and evaluation. Only the facets of the material remain, without colour map
/// and mask.
[[nodiscard]] Scene scene_of_facets(const Material& material);

/// The mip level of a trilinear fetch over `rect`: log2 of its longer side in texels, as for an isotropic footprint.
/// Negative if a texel is larger than the footprint.
[[nodiscard]] double footprint_level(const Material& material, const FootprintRect& rect);

/// The `ndf` function of a method on the first material of a scene. The GPU scene, the baked method and the material
/// must outlive it.
class MethodNdf {
 public:
  /// `tile`: side length of the square of directions per draw; 0 means 1024.
  /// Throws Error (machine) if the module does not compile, the textures do not fit, or the samplers do not support the
  /// filter.
  MethodNdf(const gl::ContextInfo& context, GpuScene& scene, const BakedMethod& baked, const Material& material,
            const FootprintFilter& filter, int tile = 0);

  /// The density at each direction, 1/sr, for the footprint `rect`; its edges are parallel to u and v. 0 at directions
  /// of length 0.
  [[nodiscard]] std::vector<float> densities(const FootprintRect& rect, std::span<const glm::vec3> directions) const;

 private:
  void set_footprint(const FootprintRect& rect) const;
  void draw(const gl::RenderTarget& target, const gl::Texture& directions) const;

  GpuScene* scene_;
  const Material* material_;
  GpuMethod gpu_;
  SamplerState sampler_state_;
  GLuint directions_unit_;
  int edge_;
  gl::Program program_;
  gl::ScreenTriangle triangle_;
};

}  // namespace footprint
