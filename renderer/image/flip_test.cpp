// FLIP against figures of the papers' formulas with every kernel as the square that the paper prints (convolved in two
// dimensions, double precision, apart from this program), and against colours worked out by hand.
#include "renderer/image/flip.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

Image plain(int width, int height, const std::array<float, 3>& color) {
  Image image(width, height, 3);
  for (std::size_t i = 0; i < image.texels.size(); ++i) image.texels[i] = color.at(i % 3);
  return image;
}

// A pattern without meaning; of its right half `other` gives another.
Image flip_pattern(bool other, float power = 1.0F, float scale = 1.0F) {
  Image image(24, 16, 3);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const int k = other && x >= 12 ? 1 : 0;
      const std::array<float, 3> color{static_cast<float>((7 * x + 13 * y + 5 * k) % 17) / 16.0F,
                                       static_cast<float>((5 * x + 3 * y + 11 * k) % 13) / 12.0F,
                                       static_cast<float>((x * y + 4 * k) % 11) / 10.0F};
      for (std::size_t c = 0; c < 3; ++c) image.at(x, y)[c] = scale * std::pow(color.at(c), power);
    }
  }
  return image;
}

double mean_flip(const Image& image) {
  double sum = 0;
  for (const float value : image.texels) sum += value;
  return sum / static_cast<double>(image.texels.size());
}

TEST(Flip, IsThePapersFormulas) {
  const Image map = ldr_flip(flip_pattern(true), flip_pattern(false));
  EXPECT_NEAR(mean_flip(map), 0.188377961, 2e-6);
  EXPECT_NEAR(map.at(3, 3)[0], 0.004868033, 2e-6);
  EXPECT_NEAR(map.at(11, 8)[0], 0.186475554, 2e-6);
  EXPECT_NEAR(map.at(12, 8)[0], 0.233427917, 2e-6);
  EXPECT_NEAR(map.at(23, 15)[0], 0.586965487, 2e-6);
}

TEST(Flip, OfHighDynamicRangeIsThePapersFormulas) {
  const Image reference = flip_pattern(false, 4.0F, 20.0F), picture = flip_pattern(true, 4.0F, 20.0F);
  const FlipExposures exposures = flip_exposures(reference);
  EXPECT_NEAR(exposures.start, -3.137516952, 1e-6);
  EXPECT_NEAR(exposures.stop, -0.333100665, 1e-6);
  EXPECT_EQ(exposures.count, 3);
  const Image map = hdr_flip(picture, reference, exposures);
  EXPECT_NEAR(mean_flip(map), 0.205749682, 2e-6);
  EXPECT_NEAR(map.at(12, 8)[0], 0.284888663, 2e-6);
  EXPECT_NEAR(map.at(20, 8)[0], 0.358766345, 2e-6);
}

// Without features: L* of 100 against 0 is 100^0.7 of the 41.27 between green and blue, the largest there is.
TEST(Flip, OfPlainColoursIsTheirDistance) {
  const Image green = plain(4, 4, {0, 1, 0}), blue = plain(4, 4, {0, 0, 1});
  EXPECT_NEAR(ldr_flip(green, blue).texels[0], 1.0, 1e-6);
  const double largest = 41.27, knee = 0.4 * largest, white = std::pow(100.0, 0.7);
  EXPECT_NEAR(ldr_flip(plain(4, 4, {1, 1, 1}), plain(4, 4, {0, 0, 0})).texels[0],
              0.95 + 0.05 * (white - knee) / (largest - knee), 1e-4);
}

TEST(Flip, IsNothingForEqualPictures) {
  EXPECT_EQ(mean_flip(ldr_flip(flip_pattern(false), flip_pattern(false))), 0.0);
  const Image bright = flip_pattern(false, 2.0F, 50.0F);
  EXPECT_EQ(mean_flip(hdr_flip(bright, bright, flip_exposures(bright))), 0.0);
}

TEST(Flip, OfHighDynamicRangeDependsOnNoExposure) {
  const auto at = [](float scale) {
    const Image reference = flip_pattern(false, 4.0F, scale);
    return mean_flip(hdr_flip(flip_pattern(true, 4.0F, scale), reference, flip_exposures(reference)));
  };
  EXPECT_NEAR(at(0.01F), at(300.0F), 1e-5);
}

TEST(Flip, SeesTheMoreOfADotTheNearerItIs) {
  Image dot = plain(33, 33, {0.2F, 0.2F, 0.2F});
  const Image without = dot;
  for (std::size_t c = 0; c < 3; ++c) dot.at(16, 16)[c] = 0.6F;
  EXPECT_GT(ldr_flip(dot, without, 30.0).at(16, 16)[0], 1.2F * ldr_flip(dot, without, 120.0).at(16, 16)[0]);
}

TEST(Flip, ExposuresOfBlackAndOfMostlyBlackAreFinite) {
  EXPECT_EQ(flip_exposures(plain(4, 4, {0, 0, 0})).start, 0.0);
  Image spark = plain(4, 4, {0, 0, 0});
  spark.at(1, 1)[1] = 3.0F;
  const FlipExposures exposures = flip_exposures(spark);
  EXPECT_TRUE(std::isfinite(exposures.start) && exposures.start == exposures.stop);
  EXPECT_GT(mean_flip(hdr_flip(plain(4, 4, {0, 0, 0}), spark, exposures)), 0.0);
}

// Grey in the order of a picture, not of its luminance.
Image greys(const std::vector<float>& values) {
  Image image(static_cast<int>(values.size()), 1, 3);
  for (std::size_t i = 0; i < image.texels.size(); ++i) image.texels[i] = values[i / 3];
  return image;
}

// The stops between the brightest pixel, 8, and the median: of 3, the mean of the middle two, they would be 1.415.
TEST(Flip, TheMedianOfAnEvenCountIsTheUpperMiddle) {
  const auto stops = [](const Image& reference) {
    const FlipExposures exposures = flip_exposures(reference);
    return exposures.stop - exposures.start;
  };
  EXPECT_NEAR(stops(greys({4, 1, 8, 2})), 1.0, 1e-6);
  EXPECT_NEAR(stops(greys({4, 1, 8, 2, 0.5F})), 2.0, 1e-6);
}

// A least luminance that is the same for all pictures would cut the dimmer one's stops short.
TEST(Flip, ExposuresOfMostlyBlackDependOnNoUnitOfRadiance) {
  for (const float unit : {1.0F, 1e-6F, 1e6F}) {
    const FlipExposures exposures = flip_exposures(greys({0, 8 * unit, 0, unit / 8, 0, 0}));
    EXPECT_NEAR(exposures.stop - exposures.start, 6.0, 1e-6) << unit;
    EXPECT_EQ(exposures.count, 6) << unit;
  }
}

TEST(Flip, RefusesWhatCannotBeCompared) {
  EXPECT_THROW((void)ldr_flip(plain(4, 4, {}), plain(4, 5, {})), Error);
  EXPECT_THROW((void)ldr_flip(Image(4, 4, 1), Image(4, 4, 1)), Error);
  Image broken = plain(4, 4, {});
  broken.at(2, 1)[0] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW((void)hdr_flip(broken, plain(4, 4, {}), {}), Error);
}

}  // namespace
}  // namespace footprint
