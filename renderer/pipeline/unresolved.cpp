// A pixel's standard error against its own mean.
#include "renderer/pipeline/unresolved.hpp"

#include <algorithm>

namespace footprint {
namespace {

bool is_unresolved(std::span<const float> mean, std::span<const float> error, float exposure,
                   const UnresolvedLimits& limits) {
  for (std::size_t c = 0; c < 3; ++c) {
    if (error[c] > limits.relative * mean[c] && exposure * error[c] > limits.displayed) return true;
  }
  return false;
}

}  // namespace

Image unresolved(const Supersampled& reference, float exposure, const UnresolvedLimits& limits) {
  const Image& mean = reference.mean;
  Image mask(mean.width, mean.height, 1);
  std::size_t object = 0;
  for (int y = 0; y < mean.height; ++y) {
    for (int x = 0; x < mean.width; ++x) {
      if (mean.at(x, y)[3] <= 0.0F) continue;
      ++object;
      if (is_unresolved(mean.at(x, y), reference.standard_error.at(x, y), exposure, limits)) mask.at(x, y)[0] = 1.0F;
    }
  }
  // A reference that is noisy all over has no such pixels: what is left of it would be its dark ones.
  const bool is_noise = static_cast<double>(pixel_count(mask)) > limits.most * static_cast<double>(object);
  return is_noise ? Image(mean.width, mean.height, 1) : mask;
}

void uncover(Image& picture, const Image& mask) {
  for (std::size_t i = 0; i < mask.texels.size(); ++i) {
    if (mask.texels[i] > 0.0F) picture.texels[4 * i + 3] = 0.0F;
  }
}

void leave_out(Supersampled& reference, const Image& mask) {
  uncover(reference.mean, mask);
  if (!reference.halves) return;
  uncover(reference.halves->first, mask);
  uncover(reference.halves->second, mask);
}

std::size_t pixel_count(const Image& mask) {
  return static_cast<std::size_t>(std::ranges::count_if(mask.texels, [](float value) { return value > 0.0F; }));
}

}  // namespace footprint
