// What a clear coat makes of a picture: KHR_materials_clearcoat's formula (docs/base-brdf.md, Clear coat) in double
// precision, over the coats of a pixel one by one. Shares no code with the shaders, and knows of no filter.
#pragma once

#include <vector>

#include "renderer/scene/scene.hpp"

namespace footprint::stability {

/// One pixel of the square that hard scenes are made of.
struct CoatedPixel {
  bool whole = false;  ///< all of its points lie on the square
  double share = 0.0;  ///< what the coat takes of what the base reflects
  double light = 0.0;  ///< what it reflects itself: radiance of the first channel
};

/// The coat of the scene's first material, lit by its one point light: means over points x points of every pixel, each
/// of the coat's texel there. Row 0 at the top.
[[nodiscard]] std::vector<CoatedPixel> coat_sum(const Scene& scene, const glm::ivec2& size, int points);

/// What a picture leaves to be desired.
struct CoatError {
  double each = 0.0;       ///< the largest difference of a pixel from the sum, relative
  double mean = 0.0;       ///< that of the mean over all pixels
  double step = 0.0;       ///< the largest change from a pixel to the next in its row or column, relative
  double true_step = 0.0;  ///< the sum's own
};

/// `bare` is the same picture without the coat. Only pixels that are whole count.
[[nodiscard]] CoatError coat_error(const std::vector<CoatedPixel>& sum, const Image& bare, const Image& picture);

}  // namespace footprint::stability
