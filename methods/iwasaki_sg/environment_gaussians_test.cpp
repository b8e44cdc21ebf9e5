// The light of an environment as spherical Gaussians: its sum, its colours, and lights that are Gaussians already.
#include "methods/iwasaki_sg/lobe_fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

namespace footprint::iwasaki_sg {
namespace {

template <class Radiance>
Environment environment_of(const Radiance& radiance) {
  Image map(64, 32, 3);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const glm::vec3 color{
          radiance(environment_direction({.name = "", .radiance = nullptr}, (x + 0.5) / 64.0, (y + 0.5) / 32.0))};
      std::copy_n(&color.x, 3, map.at(x, y).begin());
    }
  }
  return {.name = "made up", .radiance = std::make_shared<const Image>(std::move(map))};
}

TEST(LightGaussians, FindTwoGaussiansOfTwoColours) {
  const SphericalGaussian up{.axis = {0.0, 1.0, 0.0}, .sharpness = 20.0},
      side{.axis = {1.0, 0.0, 0.0}, .sharpness = 8.0};
  const glm::dvec3 red(3.0, 1.0, 0.5), blue(0.2, 0.4, 2.0);
  const auto gaussians =
      light_gaussians(environment_of([&](const glm::dvec3& d) { return value(up, d) * red + value(side, d) * blue; }));
  const auto radiance = [&](const glm::dvec3& d) {
    glm::dvec3 sum(0.0);
    for (const LightGaussian& g : gaussians)
      sum += value(g.lobe, d) / (2.0 * std::numbers::pi / g.lobe.sharpness * -std::expm1(-2.0 * g.lobe.sharpness)) *
             g.light;
    return sum;
  };
  for (const glm::dvec3& d :
       {up.axis, side.axis, glm::normalize(glm::dvec3(0.3, 1.0, 0.2)), glm::normalize(glm::dvec3(1.0, 0.2, -0.3))}) {
    const glm::dvec3 wanted = value(up, d) * red + value(side, d) * blue;
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(radiance(d)[i], wanted[i], 0.15 * std::max({wanted.x, wanted.y, wanted.z})) << i;
  }
}

TEST(LightGaussians, HaveAllLight) {
  const auto sky = [](const glm::dvec3& d) {
    return glm::dvec3(0.2 + std::exp(4.0 * (d.z - 1.0)), 0.3,
                      0.1 + 2.0 * std::exp(4.0 * (0.8 * d.x + 0.6 * d.z - 1.0)));
  };
  const auto gaussians = light_gaussians(environment_of(sky));
  EXPECT_LE(gaussians.size(), std::size_t{environment_gaussians});
  EXPECT_GE(gaussians.size(), 3U);
  glm::dvec3 sum(0.0);
  for (const LightGaussian& g : gaussians) sum += g.light;
  const double lobe = 2.0 * std::numbers::pi / 4.0 * -std::expm1(-8.0);  // the integral of exp(4 (cos - 1))
  const double sphere = 4.0 * std::numbers::pi;
  EXPECT_NEAR(sum.x, 0.2 * sphere + lobe, 0.01 * sum.x);
  EXPECT_NEAR(sum.y, 0.3 * sphere, 0.01 * sum.y);
  EXPECT_NEAR(sum.z, 0.1 * sphere + 2.0 * lobe, 0.01 * sum.z);
}

TEST(LightGaussians, OfABlackEnvironmentAreNone) {
  const Environment black = environment_of([](const glm::dvec3& /*d*/) { return glm::dvec3(0.0); });
  EXPECT_TRUE(light_gaussians(black).empty());
  const PrefilteredTexture texture = environment_texture(black);
  EXPECT_EQ(texture.levels.front().width, 1);
}

}  // namespace
}  // namespace footprint::iwasaki_sg
