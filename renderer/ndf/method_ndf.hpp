// A method's effective NDF, by its own shader: densities at listed directions for one footprint.
#pragma once

#include <span>
#include <vector>

#include "renderer/gl/context.hpp"
#include "renderer/ndf/footprint_texels.hpp"
#include "renderer/pipeline/surface_program.hpp"

namespace footprint {

/// A plane of one material: what a method bakes and what the GPU holds, with nothing but the facets left of the
/// material (no colour map, no mask).
[[nodiscard]] Scene scene_of_facets(const Material& material);

/// The mip level that a method's trilinear fetch takes for `rect`: log2 of its longer side in texels, as an isotropic
/// footprint has it; below 0 where a texel is larger than the footprint.
[[nodiscard]] double footprint_level(const Material& material, const FootprintRect& rect);

/// A method on the first material of a scene, ready to evaluate its `ndf`. The scene on the GPU, the baked method and
/// the material must outlive it.
class MethodNdf {
 public:
  /// `tile`: side of the square of directions that is evaluated at once; 0: 1024. Throws Error (machine): the module
  /// does not compile, the textures do not fit, the samplers have no such filter.
  MethodNdf(const gl::ContextInfo& context, GpuScene& scene, const BakedMethod& baked, const Material& material,
            const FootprintFilter& filter, int tile = 0);

  /// The method's density per solid angle at each direction, for a pixel whose footprint is `rect`: its centre, and
  /// edges as long as the rectangle along u and along v. 0 at directions of length 0.
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
  gl::VertexArray no_vertices_;
};

}  // namespace footprint
