// Error measures against values worked out by hand, and their invariances.
#include "renderer/image/metrics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

Image noise(unsigned seed, float maximum = 1.0F) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<float> uniform(0.0F, maximum);
  Image image(9, 7, 4, 1.0F);
  for (std::size_t i = 0; i < image.texels.size(); ++i) {
    if (i % 4 != 3) image.texels[i] = uniform(generator);
  }
  return image;
}

Image pixels(const std::vector<std::array<float, 4>>& values) {
  Image image(static_cast<int>(values.size()), 1, 4);
  for (std::size_t i = 0; i < values.size(); ++i)
    std::ranges::copy(values[i], image.at(static_cast<int>(i), 0).begin());
  return image;
}

void scale_radiance(Image& image, float factor) {
  for (std::size_t i = 0; i < image.texels.size(); ++i) {
    if (i % 4 != 3) image.texels[i] *= factor;
  }
}

std::string error_text(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    return error.what();
  }
  return "no error";
}

// By hand: the second pixel is exact, black against black is no error, and black against anything is 1.
TEST(Metrics, SmapeIsTheDifferenceOverTheSum) {
  const Image reference = pixels({{1, 2, 0, 1}, {5, 6, 7, 1}, {4, 0, 0, 1}, {9, 9, 9, 0.5F}});
  const Image picture = pixels({{3, 2, 0, 1}, {5, 6, 7, 1}, {0, 0, 8, 1}, {1, 1, 1, 1}});
  EXPECT_NEAR(compare_images(picture, reference, 1.0F)->smape.value(), (0.5 + 0 + 0 + 0 + 1 + 0 + 1) / 9, 1e-12);
  Image interior(4, 1, 1);
  EXPECT_FALSE(compare_images(picture, reference, 1.0F, interior)->smape);
  interior.texels = {1, 1, 0, 1};
  const ErrorFigures figures = compare_images(picture, reference, 1.0F, interior).value();
  EXPECT_NEAR(figures.smape.value(), 0.5 / 6, 1e-12);
  EXPECT_EQ(figures.normalized_color, compare_images(picture, reference, 1.0F)->normalized_color);
}

// Twice the radiance of both changes nothing, nor does an exchange of image and reference.
TEST(Metrics, SmapeIsSymmetricAndHasNoUnit) {
  Image picture = noise(1), reference = noise(2);
  const double smape = compare_images(picture, reference, 1.0F)->smape.value();
  EXPECT_NEAR(smape, 0.38, 0.1);
  EXPECT_NEAR(compare_images(reference, picture, 1.0F)->smape.value(), smape, 1e-12);
  scale_radiance(picture, 1000.0F);
  scale_radiance(reference, 1000.0F);
  EXPECT_NEAR(compare_images(picture, reference, 1.0F)->smape.value(), smape, 1e-6);
}

// Three pixels off by .1, .2 and .4 in red, a fourth beside the object.
TEST(Metrics, ErrorOverSomePixels) {
  const Image reference = pixels({{0.1F, 0, 0, 1}, {0.1F, 0, 0, 1}, {0.1F, 0, 0, 1}, {0.1F, 0, 0, 0}});
  const Image picture = pixels({{0.2F, 0, 0, 1}, {0.3F, 0, 0, 1}, {0.5F, 0, 0, 1}, {0.9F, 0, 0, 1}});
  Image mask(4, 1, 1);
  EXPECT_FALSE(normalized_color(picture, reference, 1.0F, mask).has_value());
  mask.texels = {1, 0, 1, 1};
  EXPECT_NEAR(normalized_color(picture, reference, 1.0F, mask).value(), 0.5 / 2 / std::sqrt(3.0), 1e-7);
  EXPECT_EQ(object_pixels(reference).texels, (std::vector<float>{1, 1, 1, 0}));
  EXPECT_NEAR(normalized_color(picture, reference, 1.0F, object_pixels(reference)).value(),
              compare_images(picture, reference, 1.0F)->normalized_color, 1e-12);
  EXPECT_THROW((void)normalized_color(picture, reference, 1.0F, Image(3, 1, 1)), Error);
}

// Two object pixels, worked out by hand. Exposure 2: shown differences (.2, 0, 0) and, clamped at 1, (0, .5, 0).
TEST(Metrics, HandComputedFigures) {
  const Image reference = pixels({{0.1F, 0.2F, 0.3F, 1}, {0.8F, 0.25F, 0.0F, 1}});
  const Image picture = pixels({{0.2F, 0.2F, 0.3F, 1}, {2.0F, 0.5F, 0.0F, 1}});
  const ErrorFigures figures = compare_images(picture, reference, 2.0F).value();
  EXPECT_NEAR(figures.normalized_color, (0.2 + 0.5) / std::sqrt(3.0) / 2, 1e-7);
  EXPECT_NEAR(figures.psnr, 10 * std::log10(6 / (0.04 + 0.25)), 1e-6);
  const double squares = 0.01 + 1.44 + 0.0625;
  const double reference_squares = 0.01 + 0.04 + 0.09 + 0.64 + 0.0625;
  EXPECT_NEAR(figures.relative_rmse, std::sqrt(squares / reference_squares), 1e-7);
  EXPECT_NEAR(figures.energy_bias, (3.2 - 1.65) / 1.65, 1e-6);
  const double first = 0.2126 * 0.1 + 0.7152 * 0.2 + 0.0722 * 0.3;
  const double second = 0.2126 * 0.8 + 0.7152 * 0.25;
  const double epsilon = 0.01 * std::pow((first + second) / 2, 2);
  EXPECT_NEAR(figures.relmse, (0.01 / (0.01 + epsilon) + 1.44 / (0.64 + epsilon) + 0.0625 / (0.0625 + epsilon)) / 6,
              1e-6);
}

// Sparkles elsewhere are as many; dimmer or fewer ones are not. Values over white are white.
TEST(Metrics, LuminanceDistanceIsThatOfHistograms) {
  const Image reference = pixels({{0, 0, 0, 1}, {9, 9, 9, 1}, {0, 0, 0, 1}, {0.5F, 0.5F, 0.5F, 1}});
  const auto distance = [&](const Image& picture) {
    return compare_images(picture, reference, 1.0F)->luminance_distance;
  };
  EXPECT_NEAR(distance(reference), 0, 1e-12);
  EXPECT_NEAR(distance(pixels({{2, 2, 2, 1}, {0, 0, 0, 1}, {0.5F, 0.5F, 0.5F, 1}, {0, 0, 0, 1}})), 0, 1e-7);
  EXPECT_NEAR(distance(pixels({{0, 0, 0, 1}, {0.5F, 0.5F, 0.5F, 1}, {0, 0, 0, 1}, {0.5F, 0.5F, 0.5F, 1}})), 0.125,
              1e-7);
  // The same mean, without a sparkle: sorted (0, 0, .5, 1) against .375 throughout.
  EXPECT_NEAR(distance(pixels(std::vector<std::array<float, 4>>(4, {0.375F, 0.375F, 0.375F, 1}))), 0.375, 1e-6);
  // Green is brighter than blue: 0.7152 over 0.0722.
  const Image black = pixels({{0, 0, 0, 1}});
  EXPECT_NEAR(compare_images(pixels({{0, 1, 0, 1}}), black, 1.0F)->luminance_distance, 0.7152, 1e-6);
}

// Four object pixels and one that is none: black, just below and at the border of the second bin, over white.
TEST(Metrics, HistogramsCountTheObjectsPixelsByLuminance) {
  const float border = 1.0F / 32;
  const Image reference = pixels({{0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}, {1, 1, 1, 0.5F}});
  const Image picture = pixels({{0, 0, 0, 1},
                                {0.99F * border, 0.99F * border, 0.99F * border, 1},
                                {1.01F * border, 1.01F * border, 1.01F * border, 1},
                                {3, 3, 3, 1},
                                {1, 1, 1, 1}});
  const ErrorFigures figures = compare_images(picture, reference, 1.0F).value();
  LuminanceHistogram expected{};
  expected[0] = 2;
  expected[1] = 1;
  expected[31] = 1;
  EXPECT_EQ(figures.luminances, expected);
  EXPECT_EQ(figures.reference_luminances, (LuminanceHistogram{4}));
}

TEST(Metrics, EqualPicturesDifferByNothing) {
  const Image image = noise(1, 3.0F);
  const ErrorFigures figures = compare_images(image, image, 1.0F).value();
  EXPECT_EQ(figures.normalized_color, 0);
  EXPECT_EQ(figures.relative_rmse, 0);
  EXPECT_EQ(figures.relmse, 0);
  EXPECT_EQ(figures.energy_bias, 0);
  EXPECT_EQ(figures.psnr, std::numeric_limits<double>::infinity());
}

// The whole range of the measure: black against white is 1.
TEST(Metrics, BlackAgainstWhiteIsOne) {
  const Image black = pixels({{0, 0, 0, 1}});
  const Image white = pixels({{1, 1, 1, 1}});
  const ErrorFigures figures = compare_images(black, white, 1.0F).value();
  EXPECT_DOUBLE_EQ(figures.normalized_color, 1);
  EXPECT_NEAR(figures.psnr, 0, 1e-12);
  EXPECT_DOUBLE_EQ(figures.energy_bias, -1);
  EXPECT_DOUBLE_EQ(figures.relative_rmse, 1);
}

// Against a black reference relative figures have no scale.
TEST(Metrics, ABlackReferenceGivesInfiniteRelativeErrors) {
  const Image black = pixels({{0, 0, 0, 1}});
  const Image white = pixels({{1, 1, 1, 1}});
  const ErrorFigures figures = compare_images(white, black, 1.0F).value();
  EXPECT_TRUE(std::isinf(figures.relmse));
  EXPECT_TRUE(std::isinf(figures.relative_rmse));
  EXPECT_TRUE(std::isinf(figures.energy_bias));
  EXPECT_EQ(compare_images(black, black, 1.0F)->relmse, 0);
}

TEST(Metrics, RadianceTimesExposureIsWhatCounts) {
  Image picture = noise(1), reference = noise(2);
  const ErrorFigures before = compare_images(picture, reference, 0.75F).value();
  scale_radiance(picture, 8.0F);
  scale_radiance(reference, 8.0F);
  const ErrorFigures after = compare_images(picture, reference, 0.75F / 8).value();
  EXPECT_DOUBLE_EQ(after.normalized_color, before.normalized_color);
  EXPECT_DOUBLE_EQ(after.psnr, before.psnr);
  EXPECT_NEAR(after.relative_rmse, before.relative_rmse, 1e-12);
  EXPECT_NEAR(after.relmse, before.relmse, 1e-12);
  EXPECT_NEAR(after.energy_bias, before.energy_bias, 1e-12);
}

TEST(Metrics, TheBackgroundNeverCounts) {
  const Image object_picture = pixels({{0.5F, 0.5F, 0.5F, 1}});
  const Image object_reference = pixels({{0.25F, 0.5F, 0.5F, 1}});
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Image picture = pixels({{9, 9, 9, 1}, {0.5F, 0.5F, 0.5F, 1}, {nan, 9, 9, 1}});
  const Image reference = pixels({{1, 2, 3, 0}, {0.25F, 0.5F, 0.5F, 1}, {1, 2, 3, 0.97F}});
  EXPECT_EQ(compare_images(picture, reference, 1.0F)->normalized_color,
            compare_images(object_picture, object_reference, 1.0F)->normalized_color);
  EXPECT_EQ(compare_images(picture, reference, 1.0F)->relmse,
            compare_images(object_picture, object_reference, 1.0F)->relmse);
  EXPECT_EQ(object_pixel_count(reference), 1U);
  EXPECT_EQ(error_map(picture, reference, 1.0F).texels[0], 0.0F);
  EXPECT_EQ(error_map(picture, reference, 1.0F).texels[2], 0.0F);
}

TEST(Metrics, APixelLeftUncoveredCountsAsBlack) {
  const Image reference = pixels({{0.25F, 0.5F, 0.5F, 1}});
  const Image uncovered = pixels({{0.25F, 0.5F, 0.5F, 0}});
  const Image black = pixels({{0, 0, 0, 1}});
  EXPECT_EQ(compare_images(uncovered, reference, 1.0F)->normalized_color,
            compare_images(black, reference, 1.0F)->normalized_color);
  EXPECT_EQ(compare_images(uncovered, reference, 1.0F)->energy_bias, -1.0);
}

TEST(Metrics, OneChangedPixelChangesTheFigureByItsShare) {
  const Image reference = noise(3);
  Image picture = reference;
  picture.at(4, 2)[1] = reference.at(4, 2)[1] < 0.5F ? reference.at(4, 2)[1] + 0.25F : reference.at(4, 2)[1] - 0.25F;
  const double expected = 0.25 / std::sqrt(3.0) / 63;
  EXPECT_NEAR(compare_images(picture, reference, 1.0F)->normalized_color, expected, 1e-8);
  const Image map = error_map(picture, reference, 1.0F);
  EXPECT_NEAR(map.at(4, 2)[0], 0.25 / std::sqrt(3.0), 1e-6);
  EXPECT_EQ(std::ranges::count_if(map.texels, [](float value) { return value != 0; }), 1);
}

// The figure is the mean of the picture that the page shows.
TEST(Metrics, TheFigureIsTheMeanOfTheErrorMap) {
  const Image picture = noise(4, 2.0F), reference = noise(5, 2.0F);
  const Image map = error_map(picture, reference, 0.8F);
  double sum = 0;
  for (const float value : map.texels) sum += value;
  EXPECT_NEAR(compare_images(picture, reference, 0.8F)->normalized_color, sum / 63, 1e-7);
}

TEST(Metrics, NoFullyCoveredPixelNoFigures) {
  EXPECT_FALSE(compare_images(pixels({{1, 1, 1, 1}}), pixels({{1, 1, 1, 0.5F}}), 1.0F).has_value());
  EXPECT_FALSE(compare_images(Image(0, 0, 4), Image(0, 0, 4), 1.0F).has_value());
}

TEST(Metrics, ACoverageOfOneLessARoundingErrorIsWhole) {
  EXPECT_EQ(object_pixel_count(pixels({{0, 0, 0, 0.9999998F}, {0, 0, 0, 4095.0F / 4096.0F}})), 1U);
}

TEST(Metrics, NotANumberIsNamedWithItsPixelAndPicture) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    const Image good = noise(6);
    Image broken = good;
    broken.at(3, 5)[2] = bad;
    const std::string in_picture = error_text([&] { (void)compare_images(broken, good, 1.0F); });
    EXPECT_NE(in_picture.find("the image, pixel (3, 5)"), std::string::npos) << in_picture;
    const std::string in_reference = error_text([&] { (void)compare_images(good, broken, 1.0F); });
    EXPECT_NE(in_reference.find("the reference, pixel (3, 5)"), std::string::npos) << in_reference;
    EXPECT_NE(error_text([&] { (void)error_map(broken, good, 1.0F); }), "no error");
  }
  Image uncovered = noise(6);
  uncovered.at(1, 1)[3] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(error_text([&] { (void)compare_images(noise(6), uncovered, 1.0F); }), "no error");
}

TEST(Metrics, PicturesOfAnotherSizeAreRefused) {
  const std::string text = error_text([] { (void)compare_images(Image(2, 2, 4, 1), Image(2, 3, 4, 1), 1.0F); });
  EXPECT_NE(text.find("2 x 2"), std::string::npos) << text;
  EXPECT_NE(text.find("2 x 3"), std::string::npos) << text;
  EXPECT_NE(error_text([] { (void)compare_images(Image(2, 2, 3, 1), Image(2, 2, 4, 1), 1.0F); }), "no error");
}

TEST(Flicker, HandComputedFigures) {
  // The picture jumps by 0.5 and by 0 where the reference moves by 0.2 and by 0, in red alone; the third pixel is not
  // an object pixel in the frame before.
  const Image before = pixels({{0.1F, 0, 0, 1}, {0.3F, 0, 0, 1}, {0, 0, 0, 1}});
  const Image picture = pixels({{0.6F, 0, 0, 1}, {0.3F, 0, 0, 1}, {1, 1, 1, 1}});
  const Image reference_before = pixels({{0.2F, 0, 0, 1}, {0.9F, 0, 0, 1}, {0, 0, 0, 0.5F}});
  const Image reference = pixels({{0.4F, 0, 0, 1}, {0.9F, 0, 0, 1}, {0, 0, 0, 1}});
  const auto found = compare_changes(before, picture, reference_before, reference, 1.0F);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->mean, 0.3 / std::sqrt(3.0) / 2.0, 1e-7);
  EXPECT_NEAR(found->p99, 0.3 / std::sqrt(3.0), 1e-7);
}

TEST(Flicker, AConstantErrorDoesNotFlicker) {
  const Image reference_before = noise(1, 0.5F), reference = noise(2, 0.5F);
  const auto lighter = [](Image image) {
    for (std::size_t i = 0; i < image.texels.size(); ++i) image.texels[i] += i % 4 != 3 ? 0.25F : 0.0F;
    return image;
  };
  const auto found = compare_changes(lighter(reference_before), lighter(reference), reference_before, reference, 1.0F);
  EXPECT_NEAR(found->mean, 0.0, 1e-7);
  EXPECT_GT(compare_images(lighter(reference), reference, 1.0F)->normalized_color, 0.2);
}

TEST(Flicker, IsOnExposedClampedValues) {
  const Image dark = pixels({{0, 0, 0, 1}}), bright = pixels({{8, 8, 8, 1}});
  EXPECT_NEAR(compare_changes(dark, bright, dark, dark, 1.0F)->mean, 1.0, 1e-12);
  EXPECT_NEAR(compare_changes(dark, bright, bright, dark, 1.0F)->mean, 2.0, 1e-12);
  EXPECT_NEAR(compare_changes(dark, bright, dark, dark, 0.0625F)->mean, 0.5, 1e-12);
}

TEST(Flicker, ThePercentileIsTheNearestRank) {
  std::vector<std::array<float, 4>> values;
  for (int i = 1; i <= 100; ++i) values.push_back({static_cast<float>(i) / 100, 0, 0, 1});
  const Image ramp = pixels(values), black(100, 1, 4, 0.0F);
  Image covered = black;
  for (int x = 0; x < 100; ++x) covered.at(x, 0)[3] = 1.0F;
  EXPECT_NEAR(compare_changes(covered, ramp, covered, covered, 1.0F)->p99, 0.99 / std::sqrt(3.0), 1e-7);
}

TEST(Flicker, OverAMaskCountsItsPixelsAlone) {
  const Image before = pixels({{0, 0, 0, 1}, {0, 0, 0, 1}}), picture = pixels({{0.5F, 0.5F, 0.5F, 1}, {0, 0, 0, 1}});
  Image mask(2, 1, 1);
  mask.at(0, 0)[0] = 1.0F;
  EXPECT_NEAR(compare_changes(before, picture, before, before, 1.0F, mask)->mean, 0.5, 1e-7);
  EXPECT_NEAR(compare_changes(before, picture, before, before, 1.0F)->mean, 0.25, 1e-7);
  Image broken = picture;
  broken.at(1, 0)[0] = std::numeric_limits<float>::infinity();
  EXPECT_NEAR(compare_changes(before, broken, before, before, 1.0F, mask)->mean, 0.5, 1e-7);
  mask.at(0, 0)[0] = 0.0F;
  EXPECT_FALSE(compare_changes(before, picture, before, before, 1.0F, mask));
  EXPECT_NE(
      error_text([&] { (void)compare_changes(before, picture, before, before, 1.0F, Image(1, 1, 1)); }).find("mask"),
      std::string::npos);
}

TEST(TrailingEdges, ArePixelsThatGotDarkerByTheStepInBothReferences) {
  const Image before = pixels({{8, 8, 8, 1}, {0.5F, 0.5F, 0.5F, 1}, {0, 0, 0, 1}, {1, 1, 1, 0.5F}, {1, 1, 1, 1}});
  const Image now =
      pixels({{0.85F, 0.85F, 0.85F, 1}, {0.45F, 0.45F, 0.45F, 1}, {1, 1, 1, 1}, {0, 0, 0, 1}, {0, 0, 0, 0}});
  EXPECT_EQ(trailing_edges(before, now, 1.0F).texels, (std::vector<float>{1, 0, 0, 0, 0})) << "8 is shown as 1";
  EXPECT_EQ(trailing_edges(before, now, 4.0F).texels, (std::vector<float>{0, 0, 0, 0, 0})) << "both are shown as 1";
}

TEST(HighlightEnergy, IsThePartAboveTheLevelUnclamped) {
  const Image reference = pixels({{0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 0.5F}});
  const Image picture = pixels({{4, 4, 4, 1}, {0.5F, 0.5F, 0.5F, 1}, {9, 9, 9, 1}});
  EXPECT_NEAR(*highlight_energy(picture, reference, 1.0F), (4.0 - highlight_level) / 2.0, 1e-6);
  EXPECT_NEAR(*highlight_energy(picture, reference, 0.25F), (1.0 - highlight_level) / 2.0, 1e-6);
  EXPECT_NEAR(*highlight_energy(picture, reference, 0.125F), 0.0, 1e-12);
  EXPECT_FALSE(highlight_energy(picture, pixels({{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}}), 1.0F));
}

TEST(Flicker, NoPixelCoveredInBothFramesNoFigures) {
  const Image left = pixels({{0, 0, 0, 1}, {0, 0, 0, 0}}), right = pixels({{0, 0, 0, 0}, {0, 0, 0, 1}});
  EXPECT_FALSE(compare_changes(left, right, left, right, 1.0F));
}

TEST(Flicker, WhatIsNoNumberIsNamed) {
  Image broken = noise(3);
  broken.at(2, 1)[0] = std::numeric_limits<float>::quiet_NaN();
  const Image good = noise(4);
  EXPECT_NE(
      error_text([&] { (void)compare_changes(broken, good, good, good, 1.0F); }).find("image before, pixel (2, 1)"),
      std::string::npos);
  EXPECT_NE(error_text([&] { (void)compare_changes(good, good, Image(1, 1, 4), good, 1.0F); }), "no error");
}

}  // namespace
}  // namespace footprint
