// The draws and copies of a frame build, recorded so that their cost on a GPU can be estimated.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "renderer/core/gpu_cost.hpp"
#include "renderer/gl/objects.hpp"

namespace footprint {

/// The texture that a unit has bound, and whether its sampler blends levels.
/// name: in the shader.
/// is_array: whether the shader reads an array of textures.
[[nodiscard]] ReadTexture bound_texture(const std::string& name, GLuint unit, bool is_array);

/// One draw, or one copy of texels.
struct RecordedDraw {
  std::string vertex, fragment;         ///< GLSL; both are empty for a copy
  double pixels = 0;                    ///< that were drawn, or texels that were copied
  double lookups = 0;                   ///< texture lookups per pixel
  std::vector<ColorTarget> targets;     ///< in the order of the outputs
  std::map<int, ReadTexture> textures;  ///< by unit
};

using RecordedDraws = std::vector<RecordedDraw>;

/// Draws, and records the draw unless `record` is null. It is then counted on the GPU, so it waits.
/// program: in use.
/// lookups: texture lookups per pixel; the rounds of loops that a compiler does not unroll follow from it.
/// draw: one draw call into the bound framebuffer.
void draw_recorded(RecordedDraws* record, const gl::Program& program, double lookups,
                   const std::function<void()>& draw);

/// Records a copy of texels to another texture of the same format, unless `record` is null.
/// texels: of all layers.
void record_copy(RecordedDraws* record, const gl::Texture& from, double texels);

}  // namespace footprint
