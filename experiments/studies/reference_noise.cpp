// Noise from the two halves of a reference, which differ by nothing else.
#include "experiments/studies/reference_noise.hpp"

#include <algorithm>

#include "renderer/image/metrics.hpp"

namespace footprint {
namespace {

constexpr double halves_over_whole = 2.0;  // A - B has twice the deviation of the reference's own error

}  // namespace

std::optional<double> noise_floor(const Supersampled& reference, float exposure) {
  return noise_floor_over(reference, exposure, object_pixels(reference.mean));
}

std::optional<double> noise_floor_over(const Supersampled& reference, float exposure, const Image& mask) {
  if (!reference.halves) return std::nullopt;
  const auto difference = normalized_color_over(reference.halves->first, reference.halves->second, exposure, mask);
  if (!difference) return std::nullopt;
  return *difference / halves_over_whole;
}

std::optional<Flicker> flicker_between(const Image& before, const Image& picture, const Supersampled& reference_before,
                                       const Supersampled& reference, float exposure) {
  const auto figures = compare_changes(before, picture, reference_before.mean, reference.mean, exposure);
  if (!figures) return std::nullopt;
  Flicker flicker{.mean = figures->mean, .p99 = figures->p99, .noise_floor = {}};
  if (!reference_before.halves || !reference.halves) return flicker;
  const auto& [old_even, old_odd] = *reference_before.halves;
  const auto& [even, odd] = *reference.halves;
  if (const auto noise = compare_changes(old_even, even, old_odd, odd, exposure)) {
    flicker.noise_floor = noise->mean / halves_over_whole;
  }
  return flicker;
}

Image as_converged(const Image& picture, const Image& same, const Image& converged) {
  Image out = converged;
  for (std::size_t t = 0; t < out.texels.size(); t += 4) {
    if (picture.texels[t + 3] <= 0.0F || same.texels[t + 3] <= 0.0F) continue;
    for (std::size_t c = t; c < t + 3; ++c)
      out.texels[c] = std::max(converged.texels[c] + (picture.texels[c] - same.texels[c]), 0.0F);
  }
  return out;
}

}  // namespace footprint
