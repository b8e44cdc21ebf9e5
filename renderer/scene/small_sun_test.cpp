// A texel or a few that have a part of an environment's light are told apart, to the last bit of that light; a soft
// sun, an even sky and coarse maps have none.
#include "renderer/scene/small_sun.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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
    const auto apart = sun_apart(environment);
    ASSERT_TRUE(apart.has_value()) << sun;
    const double light = texel * (sun - 1.0);
    EXPECT_NEAR(apart->sun.irradiance.g / light, 1.0, 1e-4) << sun;
    EXPECT_NEAR(apart->sun.share, light / (light + 4.0 * pi), 1e-4) << sun;
    const glm::dvec3 there = environment_direction(environment, 170.5 / 512.0, 64.5 / 256.0);
    EXPECT_LT(glm::length(apart->sun.direction - there), 1e-6) << sun;
    for (const float value : apart->rest.radiance->texels) ASSERT_EQ(value, 1.0F);
    EXPECT_EQ(apart->rest.rotation, environment.rotation);
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
  const auto apart = sun_apart(environment);
  ASSERT_TRUE(apart.has_value());
  const glm::dvec3 all = 4.0 * pi * mean_radiance(*environment.radiance);
  const glm::dvec3 parts = apart->sun.irradiance + 4.0 * pi * mean_radiance(*apart->rest.radiance);
  EXPECT_NEAR(parts.r / all.r, 1.0, 1e-6);
  EXPECT_NEAR(apart->sun.irradiance.g, 0.0, 1e-12);
  EXPECT_EQ(apart->rest.radiance->at(700, 130)[0], 900.0F);
  EXPECT_EQ(apart->rest.radiance->at(301, 100)[0], 0.5F);
}

TEST(SmallSun, IsNotFoundWhereThereIsNone) {
  EXPECT_FALSE(sun_apart(even_with(1.0F)));
  EXPECT_FALSE(sun_apart(even_with(100.0F))) << "a thousandth of the light";
  EXPECT_FALSE(sun_apart(even_with(1e6F, 32))) << "a texel of 11 degrees";
  EXPECT_FALSE(sun_apart(sky_environment({})));
  EXPECT_FALSE(sun_apart(constant_environment(glm::vec3(0.0F))));
}

}  // namespace
}  // namespace footprint
