// The sum over coats against closed forms, and differences from it.
#include "tests/hard_cases/coat_sum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "tests/hard_cases/hard_maps.hpp"
#include "tests/hard_cases/hard_scenes.hpp"

namespace footprint::hard_cases {
namespace {

constexpr double candela = 4.0, height = 1.5;

// Light and viewer are at one point above the middle of the square.
Scene coated_square(float weight, float roughness) {
  Scene scene = square(tilted(0.0), 0.4F);
  std::get<PointLight>(scene.lights.front()).position = {0.0F, 0.0F, static_cast<float>(height)};
  ClearCoat coat;
  coat.weight = weight;
  coat.roughness = roughness;
  scene.materials.front().coat = coat;
  return scene;
}

// D = 1 / (pi alpha^2), G2 / (4 n.v) = 1 / 4, and a Fresnel term of 0.04.
double at_the_peak(double weight, double alpha) {
  return weight * 0.04 / (4.0 * std::numbers::pi * alpha * alpha) * candela / (height * height);
}

TEST(CoatSum, IsTheLobesPeakWhereViewerAndLightAreAbove) {
  for (const float roughness : {0.0F, 0.02F, 0.5F, 1.0F}) {
    const CoatedPixel pixel = coat_sum(coated_square(0.5F, roughness), {1, 1}, 1).front();
    const double alpha = std::max(static_cast<double>(roughness) * roughness, 1e-3);
    EXPECT_TRUE(pixel.whole);
    EXPECT_NEAR(pixel.share, 0.5 * 0.04, 1e-12);
    EXPECT_NEAR(pixel.light / at_the_peak(0.5, alpha), 1.0, 1e-9) << roughness;
  }
}

TEST(CoatSum, TakesTheTexelsOfAPixelOneByOne) {
  Scene scene = coated_square(1.0F, 1.0F);
  Image weights(2, 1, 1);
  weights.texels = {0.0F, 1.0F};
  scene.materials.front().coat->weight_map = TextureMap{"weights", std::make_shared<const Image>(weights), {}};
  const auto halves = coat_sum(scene, {2, 1}, 1);
  EXPECT_EQ(halves[0].light, 0.0);
  EXPECT_GT(halves[1].light, 0.0);
  scene.camera.yfov = 1e-4F;  // only the middle
  EXPECT_NEAR(coat_sum(scene, {1, 1}, 2).front().light / at_the_peak(0.5, 1.0), 1.0, 1e-6);
}

TEST(CoatSum, HasNoCoatBesideTheSquareAndNoLightFromBelow) {
  Scene scene = coated_square(1.0F, 1.0F);
  std::get<PointLight>(scene.lights.front()).position.z = -1.0F;
  const CoatedPixel below = coat_sum(scene, {1, 1}, 1).front();
  EXPECT_EQ(below.light, 0.0);
  EXPECT_NEAR(below.share, 0.04, 1e-12);
  scene.camera.world[3].x = 3.0F;
  EXPECT_FALSE(coat_sum(scene, {1, 1}, 1).front().whole);
}

Image grey(std::initializer_list<float> values) {
  Image picture(static_cast<int>(values.size()), 1, 4, 1.0F);
  int x = 0;
  for (const float value : values) picture.at(x++, 0)[0] = value;
  return picture;
}

TEST(CoatError, IsOfThePixelThatIsFurthestOff) {
  const std::vector<CoatedPixel> sum{{true, 0.5, 1.0}, {true, 0.0, 0.0}, {false, 0.0, 0.0}};
  const Image bare = grey({2.0F, 1.0F, 1.0F});
  const CoatError right = coat_error(sum, bare, grey({2.0F, 1.0F, 9.0F}));
  EXPECT_EQ(right.each, 0.0) << "beside the square nothing counts";
  EXPECT_EQ(right.mean, 0.0);
  EXPECT_EQ(right.step, 0.5);
  EXPECT_EQ(right.true_step, 0.5);
  const CoatError wrong = coat_error(sum, bare, grey({2.0F, 1.25F, 9.0F}));
  EXPECT_NEAR(wrong.each, 0.25, 1e-12);
  EXPECT_NEAR(wrong.mean, 0.25 / 3.0, 1e-12);
  EXPECT_NEAR(wrong.step, 0.375, 1e-12);
  const Image dark = grey({0.0F, 0.0F, 0.0F});
  const std::vector<CoatedPixel> unlit(3, {true, 0.5, 0.0});
  EXPECT_EQ(coat_error(unlit, dark, dark).each, 0.0) << "0 is correct";
  EXPECT_TRUE(std::isinf(coat_error(unlit, dark, grey({0.0F, 0.1F, 0.0F})).each));
  const float none = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(std::isnan(coat_error(sum, bare, grey({none, 1.0F, 9.0F})).each)) << "nor do later pixels hide it";
}

}  // namespace
}  // namespace footprint::hard_cases
