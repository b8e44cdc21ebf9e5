// The formulas of metrics.md, summed in double precision over the pixels that the reference covers wholly.
#include "renderer/image/metrics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <string_view>
#include <utility>
#include <vector>

#include "renderer/core/error.hpp"
#include "renderer/image/image.hpp"
#include "renderer/image/ssim.hpp"

namespace footprint {
namespace {

using Rgb = std::array<double, 3>;

constexpr double relmse_epsilon_share = 1e-2;  // of the squared mean luminance of the reference
constexpr double flicker_quantile = 0.99;

// Half of one sample in 4096 may be lost to rounding. NaN counts as covered, so that the check for finite values sees
// it.
bool covers_whole_pixel(std::span<const float> texel) { return !(texel[3] < 1.0F - 1.0F / 8192.0F); }

Rgb rgb_of(const Image& image, int x, int y, std::string_view which) {
  const std::span<const float> texel = image.at(x, y);
  if (!std::ranges::all_of(texel, [](float value) { return std::isfinite(value); })) {
    throw Error(
        ErrorKind::usage, fmt::format("{}, pixel ({}, {})", which, x, y), "the value is not a finite number",
        "a method that cannot sum all that a pixel covers leaves one (its README says where): take more pixels, or "
        "come nearer");
  }
  if (texel[3] <= 0) return {};  // left uncovered: black
  return {texel[0], texel[1], texel[2]};
}

void require_comparable(const Image& picture, const Image& reference) {
  if (picture.channels != 4 || reference.channels != 4) {
    throw Error(ErrorKind::usage, "comparison",
                fmt::format("the image has {} channels, the reference {}", picture.channels, reference.channels),
                "compare RGBA images with the coverage in alpha");
  }
  if (picture.width != reference.width || picture.height != reference.height) {
    throw Error(ErrorKind::usage, "comparison",
                fmt::format("the image is {} x {}, the reference {} x {}", picture.width, picture.height,
                            reference.width, reference.height),
                "compare images of one size");
  }
}

void require_mask(const Image& mask, const Image& reference) {
  if (mask.channels == 1 && mask.width == reference.width && mask.height == reference.height) return;
  throw Error(ErrorKind::usage, "comparison", "the mask is not an image of one channel and the reference's size");
}

// visit(column, row, image's rgb, reference's rgb), row by row, over the object pixels in `mask`, or all if that is
// empty; others need not be finite.
template <typename Visit>
void visit_object_pixels(const Image& picture, const Image& reference, Visit visit, const Image& mask = {}) {
  if (!mask.empty()) require_mask(mask, reference);
  require_comparable(picture, reference);
  for_each_texel(reference, [&](int x, int y) {
    const bool is_masked = !mask.empty() && mask.at(x, y)[0] <= 0.0F;
    if (is_masked || !covers_whole_pixel(reference.at(x, y))) return;
    const Rgb expected = rgb_of(reference, x, y, "the reference");
    visit(x, y, rgb_of(picture, x, y, "the image"), expected);
  });
}

double squared(double value) { return value * value; }

// Values as shown by a display of peak 1.
double displayed(double value, double exposure) { return std::clamp(exposure * value, 0.0, 1.0); }

LuminanceHistogram make_histogram(std::span<const double> luminances) {
  LuminanceHistogram counts{};
  for (const double y : luminances) {
    const auto bin = static_cast<std::size_t>(y * static_cast<double>(counts.size()));
    ++counts[std::min(bin, counts.size() - 1)];
  }
  return counts;
}

// The mean distance of two lists of one size, each sorted: Wasserstein's distance of their distributions.
double sorted_distance(std::vector<double> a, std::vector<double> b) {
  std::ranges::sort(a);
  std::ranges::sort(b);
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
  return sum / static_cast<double>(a.size());
}

double shown_luminance(const Rgb& rgb, double exposure) {
  return luminance(displayed(rgb[0], exposure), displayed(rgb[1], exposure), displayed(rgb[2], exposure));
}

// Sum over channels of squared differences of displayed values.
double displayed_squared_distance(const Rgb& a, const Rgb& b, double exposure) {
  double sum = 0;
  for (std::size_t c = 0; c < a.size(); ++c) sum += squared(displayed(a[c], exposure) - displayed(b[c], exposure));
  return sum;
}

// 0 / 0 is 0: nothing differs from nothing. Anything else over 0 is infinite.
double ratio(double difference, double scale) {
  if (difference == 0) return 0;
  return scale > 0 ? difference / scale : std::copysign(std::numeric_limits<double>::infinity(), difference);
}

double mean_luminance(const Image& reference) {
  double sum = 0;
  visit_object_pixels(reference, reference,
                      [&](int, int, const Rgb&, const Rgb& r) { sum += luminance(r[0], r[1], r[2]); });
  return sum / static_cast<double>(object_pixel_count(reference));
}

std::optional<double> displayed_ssim(const Image& picture, const Image& reference, float exposure) {
  Image shown(reference.width, reference.height, 1), expected = shown;
  visit_object_pixels(picture, reference, [&](int column, int row, const Rgb& x, const Rgb& r) {
    shown.at(column, row)[0] = static_cast<float>(shown_luminance(x, exposure));
    expected.at(column, row)[0] = static_cast<float>(shown_luminance(r, exposure));
  });
  return mean_ssim(shown, expected, object_pixels(reference));
}

// The symmetric error of Vogels et al. 2018 without their constant, so that it does not depend on the unit of radiance.
std::optional<double> smape(const Image& picture, const Image& reference, const Image& interior) {
  double sum = 0;
  std::size_t pixels = 0;
  const auto add = [&](int, int, const Rgb& x, const Rgb& r) {
    for (std::size_t c = 0; c < x.size(); ++c) sum += ratio(std::abs(x[c] - r[c]), std::abs(x[c]) + std::abs(r[c]));
    ++pixels;
  };
  visit_object_pixels(picture, reference, add, interior);
  return pixels > 0 ? std::optional(sum / (3 * static_cast<double>(pixels))) : std::nullopt;
}

}  // namespace

std::optional<ErrorFigures> compare_images(const Image& picture, const Image& reference, float exposure,
                                           const Image& interior) {
  require_comparable(picture, reference);
  const auto pixels = static_cast<double>(object_pixel_count(reference));
  if (pixels == 0) return std::nullopt;
  const double epsilon = relmse_epsilon_share * squared(mean_luminance(reference));

  double distance = 0, shown_squares = 0, squares = 0, reference_squares = 0, relative = 0, sum = 0, reference_sum = 0;
  std::vector<double> shown_luminances, reference_luminances;
  visit_object_pixels(picture, reference, [&](int, int, const Rgb& x, const Rgb& r) {
    shown_luminances.push_back(shown_luminance(x, exposure));
    reference_luminances.push_back(shown_luminance(r, exposure));
    const double shown = displayed_squared_distance(x, r, exposure);
    distance += std::sqrt(shown / 3);
    shown_squares += shown;
    for (std::size_t c = 0; c < x.size(); ++c) {
      squares += squared(x[c] - r[c]);
      reference_squares += squared(r[c]);
      relative += ratio(squared(x[c] - r[c]), squared(r[c]) + epsilon);
      sum += x[c];
      reference_sum += r[c];
    }
  });
  const LuminanceHistogram shown = make_histogram(shown_luminances), expected = make_histogram(reference_luminances);
  return ErrorFigures{
      .normalized_color = distance / pixels,
      .relative_rmse = std::sqrt(ratio(squares, reference_squares)),
      .relmse = relative / (3 * pixels),
      .psnr = -10 * std::log10(shown_squares / (3 * pixels)),
      .energy_bias = ratio(sum - reference_sum, reference_sum),
      .luminance_distance = sorted_distance(std::move(shown_luminances), std::move(reference_luminances)),
      .smape = smape(picture, reference, interior),
      .ssim = displayed_ssim(picture, reference, exposure),
      .luminances = shown,
      .reference_luminances = expected};
}

std::optional<double> normalized_color(const Image& picture, const Image& reference, float exposure,
                                       const Image& mask) {
  double distance = 0;
  std::size_t pixels = 0;
  const auto add = [&](int, int, const Rgb& shown, const Rgb& expected) {
    distance += std::sqrt(displayed_squared_distance(shown, expected, exposure) / 3);
    ++pixels;
  };
  visit_object_pixels(picture, reference, add, mask);
  return pixels > 0 ? std::optional(distance / static_cast<double>(pixels)) : std::nullopt;
}

std::optional<FlickerFigures> compare_changes(const Image& before, const Image& picture, const Image& reference_before,
                                              const Image& reference, float exposure, const Image& mask) {
  require_comparable(before, reference_before);
  require_comparable(reference_before, reference);
  std::vector<double> differences;
  const auto add = [&](int column, int row, const Rgb& x, const Rgb& r) {
    if (!covers_whole_pixel(reference_before.at(column, row))) return;
    const Rgb old_x = rgb_of(before, column, row, "the image before");
    const Rgb old_r = rgb_of(reference_before, column, row, "the reference before");
    double sum = 0;
    for (std::size_t c = 0; c < x.size(); ++c) {
      sum += squared(displayed(x[c], exposure) - displayed(old_x[c], exposure) - displayed(r[c], exposure) +
                     displayed(old_r[c], exposure));
    }
    differences.push_back(std::sqrt(sum / 3));
  };
  visit_object_pixels(picture, reference, add, mask);
  if (differences.empty()) return std::nullopt;
  const auto count = static_cast<double>(differences.size());
  const double mean = std::accumulate(differences.begin(), differences.end(), 0.0) / count;
  const auto rank = static_cast<std::ptrdiff_t>(std::ceil(flicker_quantile * count)) - 1;
  std::ranges::nth_element(differences, differences.begin() + rank);
  return FlickerFigures{.mean = mean, .p99 = differences[static_cast<std::size_t>(rank)]};
}

Image trailing_edges(const Image& reference_before, const Image& reference, float exposure) {
  Image edges(reference.width, reference.height, 1);
  visit_object_pixels(reference_before, reference, [&](int column, int row, const Rgb& old, const Rgb& now) {
    if (!covers_whole_pixel(reference_before.at(column, row))) return;
    if (shown_luminance(old, exposure) - shown_luminance(now, exposure) >= trailing_fall)
      edges.at(column, row)[0] = 1.0F;
  });
  return edges;
}

std::optional<double> highlight_energy(const Image& picture, const Image& reference, float exposure) {
  double sum = 0;
  std::size_t pixels = 0;
  visit_object_pixels(picture, reference, [&](int, int, const Rgb& x, const Rgb&) {
    sum += std::max(exposure * luminance(x[0], x[1], x[2]) - highlight_level, 0.0);
    ++pixels;
  });
  return pixels > 0 ? std::optional(sum / static_cast<double>(pixels)) : std::nullopt;
}

Image error_map(const Image& picture, const Image& reference, float exposure) {
  Image map(reference.width, reference.height, 1);
  visit_object_pixels(picture, reference, [&](int column, int row, const Rgb& x, const Rgb& r) {
    map.at(column, row)[0] = static_cast<float>(std::sqrt(displayed_squared_distance(x, r, exposure) / 3));
  });
  return map;
}

Image object_pixels(const Image& reference) {
  Image mask(reference.width, reference.height, 1);
  for (std::size_t i = 0; i < mask.texels.size() && reference.channels == 4; ++i)
    mask.texels[i] = covers_whole_pixel(std::span(reference.texels).subspan(4 * i, 4)) ? 1.0F : 0.0F;
  return mask;
}

std::size_t object_pixel_count(const Image& reference) {
  return static_cast<std::size_t>(std::ranges::count(object_pixels(reference).texels, 1.0F));
}

}  // namespace footprint
