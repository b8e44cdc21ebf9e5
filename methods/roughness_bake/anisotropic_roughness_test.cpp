// Directed roughness against sums over texels and against the definition of KHR_materials_anisotropy.
#include "methods/roughness_bake/roughness_bake.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "renderer/core/error.hpp"
#include "renderer/lobes/lobe.hpp"

namespace footprint::roughness_bake {
namespace {

// A covariance with the variances along and across an angle.
glm::dmat2 turned_covariance(double along, double across, double angle) {
  const glm::dvec2 d(std::cos(angle), std::sin(angle)), e(-d.y, d.x);
  return along * glm::outerProduct(d, d) + across * glm::outerProduct(e, e);
}

TEST(DirectedRoughness, HasTheWidthsOfTheCovariance) {
  constexpr double alpha2 = 0.01;
  for (const double angle : {0.0, 0.4, 1.3, 1.57, 2.5}) {
    const DirectedRoughness lobe = directed_roughness(turned_covariance(0.08, 0.005, angle), alpha2);
    const Alphas alphas = anisotropic_alphas(lobe.strength, lobe.roughness * lobe.roughness);
    EXPECT_NEAR(alphas.along, std::sqrt(alpha2 + 0.16), 1e-9);
    EXPECT_NEAR(alphas.across, std::sqrt(alpha2 + 0.01), 1e-9);
    EXPECT_NEAR(std::abs(lobe.direction.x * std::sin(angle) - lobe.direction.y * std::cos(angle)), 0.0, 1e-9);
  }
}

TEST(DirectedRoughness, IsRoundWhereSlopesAre) {
  const DirectedRoughness lobe = directed_roughness(glm::dmat2(0.02), 0.09);
  EXPECT_NEAR(lobe.strength, 0.0, 1e-6);
  EXPECT_NEAR(lobe.roughness, std::pow(0.13, 0.25), 1e-9);
  const DirectedRoughness widest = directed_roughness(glm::dmat2(5.0), 0.09);
  EXPECT_EQ(widest.roughness, 1.0);
  EXPECT_EQ(widest.strength, 0.0);
}

// By an angle: a slope across the mean's turns the normal less, the steeper the mean is.
TEST(DirectedRoughness, IsSeenFromTheMeanNormal) {
  constexpr double slope = 0.75, step = 1e-5;
  const auto normal = [](double x, double y) { return glm::normalize(glm::dvec3(-x, -y, 1.0)); };
  const glm::dvec3 n = normal(slope, 0.0);
  const double along = glm::length(normal(slope + step, 0.0) - n) / step;
  const double across = glm::length(normal(slope, step) - n) / step;
  const glm::dmat2 seen = covariance_about({slope, 0.0}, turned_covariance(0.03, 0.02, 0.0));
  EXPECT_NEAR(seen[0][0], 0.03 * along * along, 1e-6);
  EXPECT_NEAR(seen[1][1], 0.02 * across * across, 1e-6);
  EXPECT_NEAR(seen[0][1], 0.0, 1e-12);
}

// Grooves that lean by +-0.5 along a direction of 30 degrees, alternating from texel to texel.
Material grooved(float roughness) {
  Image normals(4, 4, 4, 1.0F);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      const double slope = (x + y) % 2 == 0 ? 0.5 : -0.5;
      const glm::dvec3 n = glm::normalize(glm::dvec3(-slope * std::cos(0.5236), -slope * std::sin(0.5236), 1.0));
      for (int c = 0; c < 3; ++c) normals.at(x, y)[static_cast<std::size_t>(c)] = static_cast<float>(n[c]);
    }
  }
  Material material;
  material.roughness = roughness;
  material.normal_map = TextureMap{"grooves", std::make_shared<const Image>(normals), {}};
  return material;
}

TEST(DirectedChain, HasTheGroovesOfEveryLevel) {
  const std::vector<Image> chain = directed_chain(grooved(0.4F));
  ASSERT_EQ(chain.size(), 3U);
  for (const float* texel : {&chain[1].texels[0], &chain[1].texels[12], &chain[2].texels[0]}) {
    EXPECT_NEAR(std::abs(2.0 * texel[0] - 1.0), std::cos(0.5236), 1e-4);
    EXPECT_NEAR(std::abs(2.0 * texel[1] - 1.0), std::sin(0.5236), 1e-4);
    EXPECT_NEAR(texel[3], 0.4, 1e-4);
    const Alphas alphas = anisotropic_alphas(texel[2], 0.16);
    EXPECT_NEAR(alphas.along, std::sqrt(0.16 * 0.16 + 2.0 * 0.25), 1e-4);
  }
  EXPECT_NEAR(chain[0].texels[2], 0.0, 1e-3);  // one texel has no spread
  EXPECT_NEAR(chain[0].texels[3], 0.4, 1e-4);
}

TEST(DirectedChain, RefusesLobesOfOneWidthAndMapsApart) {
  Material round = grooved(0.4F);
  round.brdf.distribution = NormalDistribution::vmf;
  EXPECT_THROW((void)directed_chain(round), Error);
  Material apart = grooved(0.4F);
  Image rough(2, 2, 2, 0.5F);
  apart.metallic_roughness_map = TextureMap{"rough", std::make_shared<const Image>(rough), {}};
  apart.metallic_roughness_map->coordinates.transform[2] = {0.5F, 0.0F};
  EXPECT_THROW((void)directed_chain(apart), Error);
}

}  // namespace
}  // namespace footprint::roughness_bake
