// What a pixel costs a method, counted and not timed: texture lookups and lobes.
#pragma once

#include "renderer/pipeline/frame.hpp"

namespace footprint {

/// Means over the pixels that the object covers wholly; of a surface of several materials all of them count.
struct PixelWork {
  double lookups = 0.0;  ///< of textures, the shared ones and an environment's included
  double lobes = 0.0;    ///< evaluated, over all lights
};

/// Counts one frame of a program whose settings are `counting`. Both are 0 where no pixel is covered.
[[nodiscard]] PixelWork pixel_work(const FrameRenderer& counting, const View& view);

}  // namespace footprint
