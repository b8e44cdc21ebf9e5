// Light by cells of directions: all of it is there, and it comes from where it came.
#include "renderer/environment/reference_tables.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace footprint::testing {
namespace {

using std::numbers::pi;

TEST(DenseLights, OfAConstantEnvironmentAreTheSolidAnglesOfACube) {
  const std::vector<DenseLight> lights = dense_lights(constant_environment({1.0F, 2.0F, 0.5F}));
  ASSERT_EQ(lights.size(), 6144U);
  glm::dvec3 sum(0.0), first_moment(0.0);
  double cosine = 0;
  for (const DenseLight& light : lights) {
    sum += light.irradiance;
    first_moment += glm::dvec3(light.irradiance.x * light.direction);
    cosine += light.irradiance.x * std::max(light.direction.y, 0.0F);
    EXPECT_NEAR(glm::length(light.direction), 1.0F, 1e-6F);
    // From a corner of a face to its middle side^2 / 3^1.5 to side^2, less or more a column of texels.
    EXPECT_GT(light.irradiance.x, 0.13 / 256.0);
    EXPECT_LT(light.irradiance.x, 1.3 / 256.0);
  }
  EXPECT_NEAR(sum.x, 4.0 * pi, 1e-4);
  EXPECT_NEAR(sum.y, 8.0 * pi, 1e-4);
  EXPECT_NEAR(sum.z, 2.0 * pi, 1e-4);
  EXPECT_LT(glm::length(first_moment), 1e-4);
  EXPECT_NEAR(cosine, pi, 2e-3);
}

TEST(DenseLights, KeepTheLightOfASky) {
  const Environment sky = sky_environment({});
  glm::dvec3 sum(0.0);
  for (const DenseLight& light : dense_lights(sky)) sum += light.irradiance;
  const glm::dvec3 expected = 4.0 * pi * mean_radiance(*sky.radiance);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], expected[c], 1e-4 * expected[c]);
}

TEST(DenseLights, ALampShinesFromItsCell) {
  Image map(64, 32, 3);
  map.at(41, 9)[1] = 5.0F;
  const Environment environment{
      .name = "lamp", .radiance = std::make_shared<const Image>(std::move(map)), .rotation = 0.8F};
  const glm::dvec3 towards = environment_direction(environment, 41.5 / 64, 9.5 / 32);
  const std::vector<DenseLight> lights = dense_lights(environment);
  ASSERT_FALSE(lights.empty());
  EXPECT_LT(lights.size(), 30U);
  for (const DenseLight& light : lights) {
    EXPECT_GT(glm::dot(glm::dvec3(light.direction), towards), std::cos(6.0 * pi / 180.0));
    EXPECT_EQ(light.irradiance.x, 0.0F);
  }
  EXPECT_TRUE(dense_lights(constant_environment(glm::vec3(0.0F))).empty());
}

}  // namespace
}  // namespace footprint::testing
