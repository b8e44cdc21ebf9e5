// Which of two displayed colours a, b is closer to r is a question of sides: |r - a| < |r - b| where
//
//   (r - (a + b) / 2) . (a - b) > 0,
//
// which is linear in r. So what noise of standard error s_c in each channel does to the left side is known exactly: its
// standard error is at most sum_c |a_c - b_c| s_c, which it is where the channels err together, as under one light.
#include "experiments/studies/significance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "renderer/image/metrics.hpp"

namespace footprint {
namespace {

constexpr double standard_errors = 3.0;
constexpr double rounding = 1e-5;  // of what is displayed: sums of 32-bit floats are no closer to the truth

double displayed(float value, float exposure) {
  return std::clamp(static_cast<double>(exposure) * static_cast<double>(value), 0.0, 1.0);
}

// Colours that are not covered are black, as errors have it.
double channel(std::span<const float> texel, std::size_t c, float exposure) {
  return texel[3] > 0.0F ? displayed(texel[c], exposure) : 0.0;
}

float verdict(std::span<const float> a, std::span<const float> b, std::span<const float> mean,
              std::span<const float> standard_error, float exposure) {
  double side = 0, noise = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double first = channel(a, c, exposure), second = channel(b, c, exposure);
    const double error = static_cast<double>(exposure) * static_cast<double>(standard_error[c]);
    side += (displayed(mean[c], exposure) - (first + second) / 2) * (first - second);
    noise += std::abs(first - second) * (standard_errors * error + rounding);
  }
  if (std::abs(side) <= noise) return 0.0F;
  return side > 0 ? 1.0F : -1.0F;
}

// Okabe and Ito's colours, which every kind of colour vision tells apart.
using Color = std::array<float, 3>;  // display values; results/report/page.css has them too

constexpr Color first_closer{0.0F, 0.447F, 0.698F}, second_closer{0.835F, 0.369F, 0.0F}, undecided{0.8F, 0.8F, 0.8F};
constexpr Color outside{1.0F, 1.0F, 1.0F};

Color color_of(float verdict, bool on_object) {
  if (!on_object) return outside;
  return verdict > 0.0F ? first_closer : verdict < 0.0F ? second_closer : undecided;
}

}  // namespace

Image verdict_picture(const Image& verdicts, const Image& object) {
  Image picture(verdicts.width, verdicts.height, 3);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x)
      std::ranges::copy(color_of(verdicts.at(x, y)[0], object.at(x, y)[0] > 0.0F), picture.at(x, y).begin());
  }
  return picture;
}

Image closer_beyond_noise(const Image& a, const Image& b, const Image& mean, const Image& standard_error,
                          float exposure) {
  const Image object = object_pixels(mean);
  Image verdicts(object.width, object.height, 1);
  for (int y = 0; y < object.height; ++y) {
    for (int x = 0; x < object.width; ++x) {
      if (object.at(x, y)[0] > 0.0F)
        verdicts.at(x, y)[0] = verdict(a.at(x, y), b.at(x, y), mean.at(x, y), standard_error.at(x, y), exposure);
    }
  }
  return verdicts;
}

std::optional<Image> closer_beyond_noise(const Image& a, const Image& b, const Supersampled& reference,
                                         float exposure) {
  if (!reference.halves) return std::nullopt;
  return closer_beyond_noise(a, b, reference.mean, reference.standard_error, exposure);
}

std::optional<CloserShares> closer_shares(const Image& verdicts, const Image& mask) {
  std::size_t pixels = 0, a = 0, b = 0;
  for (std::size_t i = 0; i < mask.texel_count(); ++i) {
    if (mask.texels[i] <= 0.0F) continue;
    ++pixels;
    a += verdicts.texels[i] > 0.0F ? 1 : 0;
    b += verdicts.texels[i] < 0.0F ? 1 : 0;
  }
  if (pixels == 0) return std::nullopt;
  const auto all = static_cast<double>(pixels);
  return CloserShares{.a = static_cast<double>(a) / all, .b = static_cast<double>(b) / all};
}

}  // namespace footprint
