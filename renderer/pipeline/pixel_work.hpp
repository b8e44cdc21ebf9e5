// What a pixel costs a method, counted and not timed: texture lookups and lobes.
#pragma once

#include "renderer/pipeline/frame.hpp"

namespace footprint {

/// Means over the pixels that the object covers wholly.
struct PixelWork {
  double lookups = 0.0;  ///< of textures, the shared ones and an environment's included
  double lobes = 0.0;    ///< evaluated, over all lights
};

/// Draws one frame that counts. Of a surface of several materials a pixel's work is that of all of them. Both are 0
/// where no pixel is covered.
[[nodiscard]] PixelWork pixel_work(const gl::ContextInfo& context, GpuScene& scene, const GpuMethod& method,
                                   const View& view, ProgramSettings settings, int tile_edge = 0);

}  // namespace footprint
