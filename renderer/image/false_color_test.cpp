// False colour is ordered, its legend and the labelled strip have the right pictures in the right places.
#include "renderer/image/false_color.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

Image ramp(int width) {
  Image image(width, 1, 1);
  for (int x = 0; x < width; ++x) image.at(x, 0)[0] = static_cast<float>(x) / static_cast<float>(width - 1);
  return image;
}

double luma(std::span<const float> rgb) { return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]; }

Image framed(int width, int height, int channels, float value) { return {width, height, channels, value}; }

bool any_white(const Image& image, int left, int right, int top, int bottom) {
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) {
      if (std::ranges::min(image.at(x, y)) > 0.9F) return true;
    }
  }
  return false;
}

TEST(FalseColor, GetsLighterAllTheWay) {
  const Image colored = false_color(ramp(1000), 1.0F);
  ASSERT_EQ(colored.channels, 3);
  for (int x = 1; x < 1000; ++x) EXPECT_GT(luma(colored.at(x, 0)), luma(colored.at(x - 1, 0))) << x;
  for (const float value : colored.texels) EXPECT_TRUE(value >= 0 && value <= 1);
}

TEST(FalseColor, IsRelativeToTheMaximum) {
  Image scaled = ramp(64);
  for (float& value : scaled.texels) value *= 0.25F;
  EXPECT_EQ(false_color(scaled, 0.25F), false_color(ramp(64), 1.0F));
}

TEST(FalseColor, ValuesOutsideTheScaleTakeItsEnds) {
  Image values(5, 1, 1);
  values.texels = {-1.0F, 0.0F, 1.0F, 7.0F, std::numeric_limits<float>::quiet_NaN()};
  const Image colored = false_color(values, 1.0F);
  EXPECT_TRUE(std::ranges::equal(colored.at(0, 0), colored.at(1, 0)));
  EXPECT_TRUE(std::ranges::equal(colored.at(3, 0), colored.at(2, 0)));
  EXPECT_TRUE(std::ranges::equal(colored.at(4, 0), colored.at(2, 0)));  // NaN must not hide in the dark
  const Image nothing = false_color(values, 0.0F);
  EXPECT_TRUE(std::ranges::equal(nothing.at(3, 0), nothing.at(1, 0)));
}

TEST(FalseColor, RefusesColours) { EXPECT_THROW((void)false_color(Image(2, 2, 3), 1.0F), Error); }

TEST(FalseColor, TheLegendShowsTheScaleOverItsLabels) {
  const Image legend = false_color_legend(256, 32, 0.125F);
  ASSERT_EQ(legend.width, 256);
  ASSERT_EQ(legend.height, 32);
  for (int x = 1; x < 256; ++x) EXPECT_GT(luma(legend.at(x, 0)), luma(legend.at(x - 1, 0)));
  EXPECT_TRUE(any_white(legend, 0, 20, 16, 32)) << "label 0";
  EXPECT_TRUE(any_white(legend, 200, 256, 16, 32)) << "label 0.125";
  EXPECT_FALSE(any_white(legend, 60, 180, 16, 32));
}

TEST(LabelledStrip, HasThePicturesAndTheirCaptions) {
  const Image strip = labelled_strip({framed(100, 80, 3, 0.5F), framed(120, 80, 1, 0.25F), framed(100, 80, 4, 0.5F)},
                                     {"one", "two", "three"});
  ASSERT_EQ(strip.channels, 3);
  ASSERT_GT(strip.height, 80);
  EXPECT_EQ(strip.at(50, 40)[1], 0.5F);
  EXPECT_EQ(strip.at(strip.width / 2, 40)[2], 0.25F);
  EXPECT_EQ(strip.at(strip.width - 50, 40)[0], 0.25F) << "alpha one half over black";
  for (const int middle : {50, strip.width / 2, strip.width - 50}) {
    EXPECT_TRUE(any_white(strip, middle - 20, middle + 20, 80, strip.height)) << middle;
  }
}

TEST(LabelledStrip, ALongCaptionWidensItsColumn) {
  const std::string caption = "toksvig:storage=fp16:power=beckmann";
  const Image strip = labelled_strip({framed(10, 40, 3, 0.5F)}, {caption});
  EXPECT_GE(strip.width, 100);
  EXPECT_EQ(strip.at(strip.width / 2, 20)[0], 0.5F);
}

TEST(LabelledStrip, RefusesWhatDoesNotFitTogether) {
  const Image picture(8, 8, 3);
  EXPECT_THROW((void)labelled_strip({}, {}), Error);
  EXPECT_THROW((void)labelled_strip({picture}, {"a", "b"}), Error);
  EXPECT_THROW((void)labelled_strip({picture, Image(8, 9, 3)}, {"a", "b"}), Error);
  EXPECT_THROW((void)labelled_strip({Image(8, 8, 2)}, {"a"}), Error);
}

// Sets FOOTPRINT_FONT while it lives.
struct GivenFont {
  explicit GivenFont(const char* file) { ::setenv("FOOTPRINT_FONT", file, 1); }
  ~GivenFont() { ::unsetenv("FOOTPRINT_FONT"); }
  GivenFont(const GivenFont&) = delete;
  GivenFont& operator=(const GivenFont&) = delete;
};

TEST(Text, WithoutAFontNothingIsDrawn) {
  const GivenFont missing("/nowhere/DejaVuSans.ttf");
  Image picture(64, 32, 3);
  draw_text(picture, 32, 16, "text", 12);
  EXPECT_EQ(picture, Image(64, 32, 3));
  EXPECT_EQ(text_width("text", 12), 0);
  EXPECT_EQ(labelled_strip({picture}, {"a caption"}).width, 64);
}

TEST(Text, IsDrawnInTheFontThatIsFound) {
  const std::string installed = find_caption_font();
  ASSERT_NE(installed, "");
  const GivenFont given(installed.c_str());
  EXPECT_EQ(find_caption_font(), installed);
  Image picture(64, 32, 3);
  draw_text(picture, 32, 16, "text", 12);
  EXPECT_NE(picture, Image(64, 32, 3));
  EXPECT_GT(text_width("text", 12), 10);
}

TEST(Text, EmptyTextDrawsNothing) {
  Image picture(16, 16, 3);
  draw_text(picture, 8, 8, "", 12);
  EXPECT_EQ(picture, Image(16, 16, 3));
}

}  // namespace
}  // namespace footprint
