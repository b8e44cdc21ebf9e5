// The draws and copies of a frame build, recorded so that their cost on a GPU can be estimated.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "renderer/gl/objects.hpp"

namespace footprint {

/// A texture of a program, as a draw leaves it bound.
struct BoundTexture {
  std::string name;
  int bits = 0;            ///< of a texel
  bool trilinear = false;  ///< its sampler blends two levels, and it has several
  double bytes = 0;        ///< of all levels and layers
};

/// The texture that a unit has bound, and whether its sampler blends levels.
/// name: in the shader.
/// is_array: whether the shader reads an array of textures.
[[nodiscard]] BoundTexture bound_texture(const std::string& name, GLuint unit, bool is_array);

/// The texels of one target of a draw.
struct TexelFormat {
  int channels = 4;
  int bits = 16;  ///< of a channel

  [[nodiscard]] double bytes() const { return channels * bits / 8.0; }
};

/// One draw, or one copy of texels.
struct RecordedDraw {
  std::string vertex, fragment;          ///< GLSL; both are empty for a copy
  double pixels = 0;                     ///< that were drawn, or texels that were copied
  double lookups = 0;                    ///< texture lookups per pixel
  std::vector<TexelFormat> targets;      ///< in the order of the outputs
  std::map<int, BoundTexture> textures;  ///< by unit
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
