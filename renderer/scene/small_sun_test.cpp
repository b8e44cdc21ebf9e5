// A texel or a few that have a part of an environment's light are separated, to the last bit of that light; a soft
// sun, an even sky and coarse maps have none.
#include "renderer/scene/environment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <memory>
#include <numbers>
#include <utility>

namespace footprint {
namespace {

using std::numbers::pi;

Environment even_with(float sun, int width = 512) {
  Image map(width, width / 2, 3, 1.0F);
  for (float& channel : map.at(width / 3, width / 8)) channel = sun;
  return {.name = "test", .radiance = std::make_shared<const Image>(std::move(map)), .rotation = 0.3F};
}

TEST(SmallSun, IsItsTexelsLightAboveTheRest) {
  const double texel = 2.0 * pi * pi / (512.0 * 256.0) * std::sin(pi * 64.5 / 256.0);
  for (const float sun : {1e4F, 1e5F, 1e6F}) {
    const Environment environment = even_with(sun);
    const SunsApart apart = suns_apart(environment);
    ASSERT_EQ(apart.suns.size(), 1U) << sun;
    const double light = texel * (sun - 1.0);
    EXPECT_NEAR(apart.suns[0].irradiance.g / light, 1.0, 1e-4) << sun;
    EXPECT_NEAR(apart.suns[0].share, light / (light + 4.0 * pi), 1e-4) << sun;
    const glm::dvec3 there = environment_direction(environment, 170.5 / 512.0, 64.5 / 256.0);
    EXPECT_LT(glm::length(apart.suns[0].direction - there), 1e-6) << sun;
    for (const float value : apart.rest.radiance->texels) ASSERT_EQ(value, 1.0F);
    EXPECT_EQ(apart.rest.rotation, environment.rotation);
  }
}

// Neither twice nor not at all: what is taken out is what is given.
TEST(SmallSun, BothPartsTogetherAreAllOfIt) {
  Image map(1024, 512, 3, 0.5F);
  for (int y = 99; y <= 101; ++y) {
    for (int x = 300; x <= 302; ++x) map.at(x, y)[0] = x == 301 && y == 100 ? 9e4F : 2e4F;
  }
  for (float& channel : map.at(700, 130)) channel = 900.0F;  // a lamp, which stays
  const Environment environment{.name = "test", .radiance = std::make_shared<const Image>(std::move(map))};
  const SunsApart apart = suns_apart(environment);
  ASSERT_EQ(apart.suns.size(), 1U);
  const glm::dvec3 all = 4.0 * pi * mean_radiance(*environment.radiance);
  const glm::dvec3 parts = apart.suns[0].irradiance + 4.0 * pi * mean_radiance(*apart.rest.radiance);
  EXPECT_NEAR(parts.r / all.r, 1.0, 1e-6);
  EXPECT_NEAR(apart.suns[0].irradiance.g, 0.0, 1e-12);
  EXPECT_EQ(apart.rest.radiance->at(700, 130)[0], 900.0F);
  EXPECT_EQ(apart.rest.radiance->at(301, 100)[0], 0.5F);
}

// Lamps of a texel: the brightest first, each with its own light; a fifth stays, and one of too little light ends it.
TEST(SmallSun, IsOneOfSeveral) {
  const auto lamps = [](std::initializer_list<float> radiances) {
    Image map(512, 256, 3, 0.1F);
    int x = 40;
    for (const float radiance : radiances) {
      map.at(x, 110)[1] = radiance;
      x += 90;
    }
    return Environment{.name = "lamps", .radiance = std::make_shared<const Image>(std::move(map))};
  };
  const Environment three = lamps({2e4F, 4e4F, 3e4F});
  const SunsApart apart = suns_apart(three);
  ASSERT_EQ(apart.suns.size(), 3U);
  double shares = 0.0;
  for (const auto& [place, column] : {std::pair(0U, 130), {1U, 220}, {2U, 40}}) {
    const glm::dvec3 there = environment_direction(three, (column + 0.5) / 512.0, 110.5 / 256.0);
    EXPECT_LT(glm::length(apart.suns[place].direction - there), 1e-6) << place;
    shares += apart.suns[place].share;
  }
  EXPECT_NEAR(apart.suns[0].irradiance.g / apart.suns[2].irradiance.g, 2.0, 1e-4);
  for (const float value : apart.rest.radiance->texels) ASSERT_EQ(value, 0.1F);
  const glm::dvec3 all = 4.0 * pi * mean_radiance(*three.radiance);
  EXPECT_NEAR(shares, 1.0 - 4.0 * pi * 0.3 / (all.r + all.g + all.b), 1e-4);
  const SunsApart five = suns_apart(lamps({1e4F, 2e4F, 4e4F, 3e4F, 2.5e4F}));
  ASSERT_EQ(five.suns.size(), most_small_suns);
  EXPECT_EQ(five.rest.radiance->at(40, 110)[1], 1e4F) << "the faintest";
  EXPECT_EQ(suns_apart(lamps({4e4F, 100.0F})).suns.size(), 1U) << "a four hundredth of the light";
}

TEST(SmallSun, IsNotFoundWhereThereIsNone) {
  EXPECT_TRUE(suns_apart(even_with(1.0F)).suns.empty());
  EXPECT_TRUE(suns_apart(even_with(100.0F)).suns.empty()) << "a thousandth of the light";
  EXPECT_TRUE(suns_apart(even_with(1e6F, 32)).suns.empty()) << "a texel of 11 degrees";
  EXPECT_TRUE(suns_apart(sky_environment({})).suns.empty());
  EXPECT_TRUE(suns_apart(constant_environment(glm::vec3(0.0F))).suns.empty());
}

}  // namespace
}  // namespace footprint
