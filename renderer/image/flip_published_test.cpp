// FLIP against figures that NVIDIA's own program gave, on pictures that a few lines make. Each is recorded in the tests
// of another project, named beside it with path and commit; pictures and figures are theirs, no line of code is.
//
// That program sums in single precision and Footprint in double: where features separate the images the two agree
// to 1e-6. Where there are none, weights that cancel leave NVIDIA's sums some FLT_EPSILON of the greys, and FLIP takes
// the square root of it: its figure is then larger, by up to 1e-4, and never smaller. How much depends on the order of
// the sums, and so on its compiler.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "renderer/image/flip.hpp"

namespace footprint {
namespace {

using Srgb = std::array<double, 3>;  // 0 to 1
using Bytes = std::array<int, 3>;    // 0 to 255

constexpr double single_precision = 1e-6;

double linear_of(double srgb) { return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4); }

template <typename Color>
Image shown_srgb(int width, int height, Color color) {
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Srgb srgb = color(x, y);
      for (std::size_t c = 0; c < 3; ++c) image.at(x, y)[c] = static_cast<float>(linear_of(srgb.at(c)));
    }
  }
  return image;
}

Srgb srgb_of(const Bytes& bytes) { return {bytes[0] / 255.0, bytes[1] / 255.0, bytes[2] / 255.0}; }

template <typename Color>
Image shown_bytes(int width, int height, Color color) {
  return shown_srgb(width, height, [color](int x, int y) { return srgb_of(color(x, y)); });
}

double mean_of_map(const Image& map) {
  double sum = 0;
  for (const float value : map.texels) sum += value;
  return sum / static_cast<double>(map.texels.size());
}

double mean_ldr(const Image& picture, const Image& reference, double pixels_per_degree = flip_pixels_per_degree) {
  return mean_of_map(ldr_flip(picture, reference, pixels_per_degree));
}

// Expects what single precision may make of `exact`, a pixel without a difference of features, between the greys
// (linear luminance) of picture and reference. `digits`: how far off the last one printed may be.
void expect_flat(double exact, double published, double digits, double grey, double other_grey) {
  const double feature = FLT_EPSILON * (grey + other_grey);
  const double raised = std::pow(exact, 1.0 - std::sqrt(feature / std::numbers::sqrt2));
  EXPECT_GE(published, exact - digits);
  EXPECT_LE(published, raised + digits);
}

double grey_of(const Srgb& srgb) {
  return (2613072.0 * linear_of(srgb[0]) + 8788810.0 * linear_of(srgb[1]) + 887015.0 * linear_of(srgb[2])) / 12288897.0;
}

// PageMastr/HeliosEngine, engine/render/tests/test_flip.cpp, commit 574d84d5: flip-evaluator 1.7, LDR, at its default
// of 67.02 pixels per degree, 64 x 48.

Bytes helios_noise(int x, int y) { return {(37 * x + 11 * y) % 256, (x * x + 3 * y) % 256, (x ^ y) * 4 % 256}; }

Bytes helios_edited(int x, int y) {
  Bytes bytes = helios_noise(x, y);
  if (x >= 10 && x < 30 && y >= 8 && y < 24) bytes[0] = 255 - bytes[0];
  if (x >= 40 && x < 60 && y >= 30 && y < 40) {
    for (int& value : bytes) value = value / 2 + 64;
  }
  return bytes;
}

Image helios_gradient(int shift) {
  return shown_bytes(64, 48, [shift](int x, int y) {
    return Bytes{4 * x % 256, 5 * y % 256, std::min(255, 2 * (x + y + shift))};
  });
}

struct HeliosFigures {
  double mean, largest, at_5_5, at_20_15, at_50_35;
};

void expect_helios(const Image& map, const HeliosFigures& published) {
  EXPECT_NEAR(mean_of_map(map), published.mean, single_precision);
  EXPECT_NEAR(*std::ranges::max_element(map.texels), published.largest, single_precision);
  EXPECT_NEAR(map.at(5, 5)[0], published.at_5_5, single_precision);
  EXPECT_NEAR(map.at(20, 15)[0], published.at_20_15, single_precision);
  EXPECT_NEAR(map.at(50, 35)[0], published.at_50_35, single_precision);
}

constexpr double helios_edited_mean = 0.1006335;

TEST(FlipPublished, OfAnEditedPatternAndOfGradients) {
  expect_helios(ldr_flip(shown_bytes(64, 48, helios_edited), shown_bytes(64, 48, helios_noise)),
                {helios_edited_mean, 0.7495291, 0.0173516, 0.2270817, 0.4830123});
  expect_helios(ldr_flip(helios_gradient(3), helios_gradient(0)),
                {0.0925208, 0.1253008, 0.0408122, 0.0756577, 0.1136432});
}

TEST(FlipPublished, TellsOtherPixelsAndAnotherDistanceApart) {
  const auto off = [](double mean) { return std::abs(mean - helios_edited_mean); };
  const Image edited = shown_bytes(64, 48, helios_edited), noise = shown_bytes(64, 48, helios_noise);
  const Image one_byte_off = shown_bytes(64, 48, [](int x, int y) {
    Bytes bytes = helios_edited(x, y);
    if (x == 30 && y == 8) bytes[0] = 255 - bytes[0];
    return bytes;
  });
  EXPECT_GT(off(mean_ldr(one_byte_off, noise)), 10 * single_precision);
  EXPECT_GT(off(mean_ldr(edited, noise, 67.1)), 10 * single_precision);
}

// odin-loki/FUSE, Source/FUSE/Renderer/tests/test_render_quality_metrics.cpp, commit 109e214a: flip_evaluator 1.7, LDR,
// at its default, 96 x 64.

constexpr int fuse_width = 96, fuse_height = 64;

Bytes fuse_pattern(int x, int y) {
  Bytes bytes{};
  for (int c = 0; c < 3; ++c) {
    int value = (2 * x + 3 * y + 40 * c) % 256;
    if ((x / 8 + y / 8) % 2 == 1) value = 255 - value;
    if ((x - 60) * (x - 60) + (y - 30) * (y - 30) < 225) value = (value + 97 * (c + 1)) % 256;
    bytes.at(static_cast<std::size_t>(c)) = value;
  }
  return bytes;
}

// At the border as beyond it.
Bytes fuse_pattern_around(int x, int y) {
  return fuse_pattern(std::clamp(x, 0, fuse_width - 1), std::clamp(y, 0, fuse_height - 1));
}

std::uint32_t fuse_hash(int x, int y, std::size_t channel, std::uint32_t seed) {
  std::uint32_t h = static_cast<std::uint32_t>(x) * 73856093U ^ static_cast<std::uint32_t>(y) * 19349663U ^
                    (static_cast<std::uint32_t>(channel) + 1U) * 83492791U ^ seed * 2654435761U;
  h ^= h >> 13U;
  h *= 0x5bd1e995U;
  return h ^ h >> 15U;
}

Bytes fuse_noise(int x, int y, std::uint32_t seed) {
  Bytes bytes = fuse_pattern(x, y);
  for (std::size_t c = 0; c < 3; ++c)
    bytes.at(c) = std::clamp(bytes.at(c) + static_cast<int>(fuse_hash(x, y, c, seed) % 41U) - 20, 0, 255);
  return bytes;
}

Bytes fuse_blurred(int x, int y) {
  Bytes sum{};
  for (int j = -1; j <= 1; ++j) {
    for (int i = -1; i <= 1; ++i) {
      for (std::size_t c = 0; c < 3; ++c) sum.at(c) += fuse_pattern_around(x + i, y + j).at(c);
    }
  }
  for (int& value : sum) value /= 9;
  return sum;
}

template <typename Color>
double fuse_mean(Color color, double pixels_per_degree = flip_pixels_per_degree) {
  return mean_ldr(shown_bytes(fuse_width, fuse_height, color), shown_bytes(fuse_width, fuse_height, fuse_pattern),
                  pixels_per_degree);
}

constexpr double fuse_noise_mean = 0.1112260, fuse_shifted_mean = 0.2636731, fuse_blurred_mean = 0.2492682;

TEST(FlipPublished, OfNoiseAShiftAndABlur) {
  EXPECT_NEAR(fuse_mean([](int x, int y) { return fuse_noise(x, y, 7); }), fuse_noise_mean, single_precision);
  EXPECT_NEAR(fuse_mean([](int x, int y) { return fuse_pattern_around(x - 1, y); }), fuse_shifted_mean,
              single_precision);
  EXPECT_NEAR(fuse_mean(fuse_blurred), fuse_blurred_mean, single_precision);
}

TEST(FlipPublished, TellsOtherNoiseAnotherShiftAndAnotherDistanceApart) {
  constexpr double apart = 10 * single_precision;
  EXPECT_GT(std::abs(fuse_mean([](int x, int y) { return fuse_noise(x, y, 8); }) - fuse_noise_mean), apart);
  EXPECT_GT(std::abs(fuse_mean([](int x, int y) { return fuse_pattern_around(x + 1, y); }) - fuse_shifted_mean), apart);
  EXPECT_GT(std::abs(fuse_mean(fuse_blurred, 67.1) - fuse_blurred_mean), apart);
}

// The default in single precision, and the radius of 10 pixels that the same file gives the filters of contrast.
TEST(FlipPublished, SeesAsFarAsNvidiasFilters) {
  EXPECT_NEAR(flip_pixels_per_degree, 67.0206451, 67.0 * FLT_EPSILON);
  // Blue, which the widest of them is for.
  const auto dot = [](int blue) {
    return shown_bytes(25, 25, [blue](int x, int y) { return Bytes{100, 100, x == 12 && y == 12 ? blue : 100}; });
  };
  const Image map = ldr_flip(dot(200), dot(100));
  EXPECT_GT(map.at(22, 12)[0], 0.0F);
  EXPECT_EQ(map.at(23, 12)[0], 0.0F);
}

TEST(FlipPublished, OfPlainColours) {
  const auto plain = [](const Bytes& bytes) {
    return shown_bytes(fuse_width, fuse_height, [bytes](int, int) { return bytes; });
  };
  constexpr Bytes grey{128, 128, 128}, tinted{140, 120, 128};
  constexpr double published = 0.2014159;
  const double exact = mean_ldr(plain(tinted), plain(grey));
  expect_flat(exact, published, single_precision, grey_of(srgb_of(tinted)), grey_of(srgb_of(grey)));
  EXPECT_GT(std::abs(mean_ldr(plain({141, 120, 128}), plain(grey)) - published), 50 * (published - exact));
}

// DoeringChristian/cairn-plot, ui/src/plots/image/webgpu/engine/kernels/__fixtures__/flip-ldr.json, commit 715edd3d:
// flip-evaluator 1.7, LDR, at 67 pixels per degree.

constexpr double cairn_pixels_per_degree = 67.0;

Image cairn_edge(int at) {
  return shown_srgb(10, 10, [at](int x, int) { return x >= at ? Srgb{1, 1, 1} : Srgb{}; });
}

// Both pictures have column 5 next to their edge: no features separate them there. Column 9 is so far from both edges
// that their difference is of the size of the rounding. They are a tenth each of the mean.
TEST(FlipPublished, OfAnEdgeThatMoves) {
  const Image map = ldr_flip(cairn_edge(6), cairn_edge(5), cairn_pixels_per_degree);
  const std::vector<double> published{0.078328, 0.357251, 0.693378, 0.773028, 0.538381, 0.497560, 0.247881, 0.094392};
  for (int x = 1; x <= 8; ++x) {
    const double column = published.at(static_cast<std::size_t>(x - 1));
    if (x == 5) {
      expect_flat(map.at(x, 4)[0], column, single_precision, 1.0, 1.0);
    } else {
      EXPECT_NEAR(map.at(x, 4)[0], column, single_precision) << "column " << x;
    }
  }
  EXPECT_NEAR(map.at(9, 4)[0], 0.019234, 3e-5);
  EXPECT_NEAR(mean_of_map(map), 0.33075914, 1.2e-5);
  EXPECT_GT(std::abs(mean_ldr(cairn_edge(6), cairn_edge(5), 66.0) - 0.33075914), 1.2e-4);
}

// Ramps of 12 steps, rounded to 6 decimals as they were written down.
Image cairn_gradient(bool flipped) {
  const auto step = [](int k) { return std::round(k / 11.0 * 1e6) / 1e6; };
  return shown_srgb(12, 12, [=](int x, int y) { return Srgb{step(flipped ? 11 - x : x), step(y), 0.5}; });
}

TEST(FlipPublished, OfAGradientAndItsMirrorImage) {
  const Image map = ldr_flip(cairn_gradient(true), cairn_gradient(false), cairn_pixels_per_degree);
  const std::array<double, 6> published{0.967064, 0.965447, 0.961524, 0.810519, 0.604498, 0.292536};
  for (int x = 0; x < 12; ++x) {
    EXPECT_NEAR(map.at(x, 0)[0], published.at(static_cast<std::size_t>(std::min(x, 11 - x))), single_precision) << x;
  }
  EXPECT_NEAR(mean_of_map(map), 0.71294415, single_precision);
  EXPECT_GT(std::abs(mean_ldr(cairn_gradient(true), cairn_gradient(false), 66.0) - 0.71294415), 10 * single_precision);
}

TEST(FlipPublished, OfRedAndBlue) {
  constexpr Srgb red{0.8, 0.2, 0.2}, blue{0.2, 0.2, 0.8}, bluer{0.2, 0.2, 0.85};
  const auto plain = [](const Srgb& srgb) { return shown_srgb(8, 8, [srgb](int, int) { return srgb; }); };
  const Image map = ldr_flip(plain(blue), plain(red), cairn_pixels_per_degree);
  for (const float value : map.texels) expect_flat(value, 0.951105, single_precision, grey_of(blue), grey_of(red));
  EXPECT_GT(std::abs(mean_ldr(plain(bluer), plain(red), cairn_pixels_per_degree) - 0.951105), 1e-4);
}

// AcademySoftwareFoundation/OpenImageIO, testsuite/flip/run.py, commit 74268f16, and ref/out.txt, commit 66c3c5ea: its
// own program after NVIDIA's, of radiance in halves; four digits are printed, of exposures three.
TEST(FlipPublished, OfPlainRadiance) {
  constexpr double digits = 5e-5;
  constexpr float dark = 0.099975586F, light = 0.89990234F;
  const Image reference(64, 64, 3, dark), picture(64, 64, 3, light);
  expect_flat(mean_ldr(picture, reference), 0.9514, digits, light, dark);

  const FlipExposures exposures = flip_exposures(reference);
  EXPECT_NEAR(exposures.start, 4.41, 5e-3);
  EXPECT_EQ(exposures.stop, exposures.start);
  EXPECT_EQ(exposures.count, 2);
  // Toned, the reference is at 0.85, and the picture beyond white.
  expect_flat(mean_of_map(hdr_flip(picture, reference, exposures)), 0.2045, digits, 1.0, 0.85);

  const FlipExposures darker{.start = 4.36, .stop = 4.36, .count = 2};
  EXPECT_GT(std::abs(mean_of_map(hdr_flip(picture, reference, darker)) - 0.2045), 10 * digits);
}

}  // namespace
}  // namespace footprint
