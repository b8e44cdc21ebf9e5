// The automatic exposure is a percentile of the luminance of whole object pixels.
#include "experiments/studies/exposure.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace footprint {
namespace {

constexpr double percentile = 0.95;
constexpr float target_luminance = 0.8F;

}  // namespace

float automatic_exposure(const Image& reference) {
  std::vector<float> luminances;
  for (std::size_t i = 0; i < reference.texels.size(); i += 4) {
    const float* const p = &reference.texels[i];
    if (p[3] == 1.0F) luminances.push_back(luminance(p[0], p[1], p[2]));
  }
  if (luminances.empty()) return 1.0F;
  const auto nth =
      luminances.begin() + static_cast<std::ptrdiff_t>(percentile * static_cast<double>(luminances.size() - 1));
  std::ranges::nth_element(luminances, nth);
  return *nth > 0.0F && std::isfinite(*nth) ? target_luminance / *nth : 1.0F;
}

Exposure choose_exposure(const std::optional<Exposure>& given, const Scene& scene, const Image& first_reference) {
  if (given) return *given;
  if (scene.exposure) return {.factor = *scene.exposure, .source = ExposureSource::scene};
  return {.factor = automatic_exposure(first_reference), .source = ExposureSource::automatic};
}

}  // namespace footprint
