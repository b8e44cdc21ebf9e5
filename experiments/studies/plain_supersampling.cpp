// Frames moved by parts of a pixel, and their mean in double.
#include "experiments/studies/plain_supersampling.hpp"

#include <fmt/format.h>

#include <cmath>
#include <random>

#include "renderer/core/random.hpp"

namespace footprint {
namespace {

// The binary digits of a number behind the point, the last one first (van der Corput).
double mirrored(unsigned number) {
  double value = 0, digit = 0.5;
  for (; number > 0; number >>= 1U, digit /= 2) value += digit * (number & 1U);
  return value;
}

}  // namespace

std::vector<glm::dvec2> frame_offsets(int spp, std::uint64_t seed) {
  if (spp == 1) return {glm::dvec2(0.0)};
  std::mt19937_64 random(seed);
  const double shift_x = uniform(random), shift_y = uniform(random);
  const auto in_pixel = [](double value) { return value - std::floor(value) - 0.5; };
  std::vector<glm::dvec2> offsets;
  for (int i = 0; i < spp; ++i)
    offsets.emplace_back(in_pixel((i + 0.5) / spp + shift_x), in_pixel(mirrored(static_cast<unsigned>(i)) + shift_y));
  return offsets;
}

Image mean_of_frames(const FrameRenderer& frames, const View& view, std::span<const glm::dvec2> offsets,
                     const Progress& progress) {
  Image mean(view.size.x, view.size.y, 4);
  std::vector<double> sums(mean.texels.size(), 0.0);
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    progress(fmt::format("{} frames", offsets.size()), static_cast<double>(i) / static_cast<double>(offsets.size()));
    const Image frame = frames.render(view, offsets[i]);
    for (std::size_t t = 0; t < sums.size(); ++t) sums[t] += frame.texels[t];  // 0 where a pixel is not covered
  }
  for (std::size_t t = 0; t < sums.size(); t += 4) {
    const double covered = sums[t + 3];
    for (std::size_t c = t; c < t + 3; ++c) mean.texels[c] = static_cast<float>(covered > 0 ? sums[c] / covered : 0.0);
    mean.texels[t + 3] = static_cast<float>(covered / static_cast<double>(offsets.size()));
  }
  return mean;
}

}  // namespace footprint
