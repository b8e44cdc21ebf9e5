// Structural similarity (Wang et al. 2004).
#pragma once

#include <optional>

#include "renderer/image/image.hpp"

namespace footprint {

/// The mean structural similarity of two images of luminances, in Gaussian windows of 11 x 11 pixels with a standard
/// deviation of 1.5: 1 for equal images, down to -1. Windows are centred on the pixels in `mask` that are five or more
/// from the border, and their weights are over the pixels in `mask` alone. None without such a pixel. picture,
/// reference: one channel, displayed luminance, 0 to 1. mask: one channel, above 0. All three have one size.
[[nodiscard]] std::optional<double> mean_ssim(const Image& picture, const Image& reference, const Image& mask);

}  // namespace footprint
