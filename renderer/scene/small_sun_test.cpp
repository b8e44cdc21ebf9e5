// One texel that has most of an environment's light is found; a soft sun, an even sky and coarse maps have none.
#include "renderer/scene/small_sun.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

namespace footprint {
namespace {

Environment even_with(float sun, int width = 512) {
  Image map(width, width / 2, 3, 1.0F);
  for (float& channel : map.at(width / 3, width / 8)) channel = sun;
  return {.name = "test", .radiance = std::make_shared<const Image>(std::move(map))};
}

TEST(SmallSun, HasTheShareOfItsTexel) {
  constexpr double pi = std::numbers::pi;
  const double texel = 2.0 * pi * pi / (512.0 * 256.0) * std::sin(pi * 64.5 / 256.0);
  for (const float sun : {1e5F, 1e6F}) {
    const double light = texel * sun;
    EXPECT_NEAR(small_sun_share(even_with(sun)), light / (light + 4.0 * pi), 2e-3) << sun;
    EXPECT_TRUE(small_sun_warning(even_with(sun)));
  }
}

TEST(SmallSun, IsNotFoundWhereThereIsNone) {
  EXPECT_FALSE(small_sun_warning(even_with(1.0F)));
  EXPECT_FALSE(small_sun_warning(even_with(100.0F)));
  EXPECT_FALSE(small_sun_warning(even_with(1e6F, 32))) << "a texel of 11 degrees";
  EXPECT_FALSE(small_sun_warning(sky_environment({})));
  EXPECT_FALSE(small_sun_warning(constant_environment(glm::vec3(0.0F))));
}

}  // namespace
}  // namespace footprint
