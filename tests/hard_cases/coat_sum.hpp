// KHR_materials_clearcoat's formula (docs/explanation/base-brdf.md, Clear coat) in double precision, summed over the
// coats of a pixel. It shares no code with the shaders and filters nothing.
#pragma once

#include <vector>

#include "renderer/scene/scene.hpp"

namespace footprint::hard_cases {

/// One pixel of the square of the hard scenes.
struct CoatedPixel {
  bool whole = false;  ///< all of its points are on the square
  double share = 0.0;  ///< the factor of the coat on the light that the base reflects
  double light = 0.0;  ///< radiance that the coat reflects, first channel
};

/// The coat of the scene's first material under its one point light, per pixel of an image of `size`. Each value is the
/// mean over points x points of the pixel, each with the coat's texel there. Row 0 is at the top.
[[nodiscard]] std::vector<CoatedPixel> coat_sum(const Scene& scene, const glm::ivec2& size, int points);

/// Errors of an image under a coat.
struct CoatError {
  double each = 0.0;       ///< the largest relative difference of a pixel from the sum
  double mean = 0.0;       ///< the relative difference of the mean over all pixels
  double step = 0.0;       ///< the largest relative change from a pixel to the next in its row or column
  double true_step = 0.0;  ///< the largest such change of the sum
};

/// `bare` is the same image without the coat. Only `whole` pixels count.
[[nodiscard]] CoatError coat_error(const std::vector<CoatedPixel>& sum, const Image& bare, const Image& picture);

}  // namespace footprint::hard_cases
