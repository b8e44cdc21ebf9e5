// Exact mip chains for any size, power of two or not.
#pragma once

#include <array>
#include <vector>

#include "renderer/image/image.hpp"

namespace footprint {

/// Level sizes follow OpenGL: floor(n / 2), at least 1, down to 1 x 1.
[[nodiscard]] int mip_level_count(int width, int height);

/// The fine texels under one coarse texel along one axis, and the share of it that each covers.
struct MipTaps {
  int first = 0;
  int count = 1;  ///< 1 to 3
  std::array<double, 3> weight{1.0, 0.0, 0.0};
};

/// The taps of coarse texel i of m = floor(n / 2), which covers [i n / m, (i + 1) n / m) of n fine ones: two whole ones
/// if n is even; for n = 2m + 1 the shares are ((m - i), m, (1 + i)) / n (Guthe and Heckbert 2005, "Non-power-of-two
/// mipmapping"); one where n = 1.
[[nodiscard]] MipTaps mip_taps(int fine_size, int i);

/// The whole chain, `finest` first, 1 x 1 last. Each coarse texel is the exact mean of the area that it covers of the
/// finer level (mip_taps per axis), so every level has the same mean of each channel, but for rounding. Sums are in
/// double precision. Errors (usage): an image without texels; (machine): the chain does not fit in memory.
[[nodiscard]] std::vector<Image> mip_chain(Image finest);

/// The chain of mip_chain, but the last channel is a weight: other channels are weighted means, and the weight is the
/// mean weight. Texels of weight 0 (invalid normals) do not contribute; if all weights are 0, the plain mean is used.
[[nodiscard]] std::vector<Image> weighted_mip_chain(Image finest);

/// An image of another size by its nearest texels: those of a smaller one are repeated.
[[nodiscard]] Image nearest_texels(const Image& image, int width, int height);

}  // namespace footprint
