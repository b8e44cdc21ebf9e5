// Crops and insets, pixel by pixel.
#include "experiments/runner/run_experiment.hpp"

#include <gtest/gtest.h>

namespace footprint {
namespace {

/// Each pixel stores its own position.
Image ramp(int width, int height) {
  Image picture(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      picture.at(x, y)[0] = static_cast<float>(x) / 1000;
      picture.at(x, y)[1] = static_cast<float>(y) / 1000;
    }
  }
  return picture;
}

TEST(ComposedFigure, ACropIsThatPartOfThePicture) {
  const Image part = cropped(ramp(100, 50), {0.25, 0.5, 0.75, 1});
  ASSERT_EQ(part.width, 50);
  ASSERT_EQ(part.height, 25);
  EXPECT_EQ(part.at(0, 0)[0], 0.025F);
  EXPECT_EQ(part.at(0, 0)[1], 0.025F);
  EXPECT_EQ(part.at(49, 24)[0], 0.074F);
  EXPECT_EQ(cropped(ramp(7, 5), {0, 0, 1, 1}), ramp(7, 5));
}

TEST(ComposedFigure, ACropOfNextToNothingIsOnePixel) {
  for (const Crop& crop : {Crop{0.5, 0.5, 0.5001, 0.5001}, Crop{0.9999, 0.9999, 1, 1}, Crop{0, 0, 1e-9, 1e-9}}) {
    const Image part = cropped(ramp(10, 10), crop);
    EXPECT_EQ(part.width, 1);
    EXPECT_EQ(part.height, 1);
  }
  EXPECT_EQ(cropped(ramp(1, 1), {0.5, 0.5, 1, 1}), ramp(1, 1));
}

TEST(ComposedFigure, AnInsetShowsItsPartInWholeFactors) {
  const Image picture = ramp(100, 100);
  const Image whole = with_inset(picture, {0.1, 0.1, 0.2, 0.2});
  ASSERT_EQ(whole.width, 100);
  const int left = 100 - 40 - 2, top = left;  // ten pixels, four times, a frame of two
  EXPECT_EQ(whole.at(left, top)[0], picture.at(10, 10)[0]);
  EXPECT_EQ(whole.at(left + 3, top + 3)[0], picture.at(10, 10)[0]);
  EXPECT_EQ(whole.at(left + 4, top)[0], picture.at(11, 10)[0]);
  EXPECT_EQ(whole.at(left + 39, top + 39)[1], picture.at(19, 19)[1]);
  EXPECT_EQ(whole.at(left - 1, top)[0], 1.0F);  // the frames are white
  EXPECT_EQ(whole.at(9, 15)[0], 1.0F);
  EXPECT_EQ(whole.at(15, 15)[0], picture.at(15, 15)[0]);
}

TEST(ComposedFigure, AnInsetLargerThanThePictureStaysInIt) {
  for (const int side : {1, 2, 3, 9}) {
    const Image whole = with_inset(ramp(side, side), {0, 0, 1, 1}, 3.0);
    EXPECT_EQ(whole.width, side);
    EXPECT_EQ(whole.height, side);
  }
}

}  // namespace
}  // namespace footprint
