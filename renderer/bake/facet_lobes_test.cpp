// Facets with several lobes: how axes turn, their mean width, and what is refused.
#include "renderer/bake/facets.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "renderer/core/error.hpp"
#include "tests/support/facet_axes.hpp"

namespace footprint::testing {
namespace {

// The rotation about z x n by the angle between them, by quaternions.
TEST(FacetLobes, AxesTurnByTheShortestRotation) {
  for (const glm::dvec3& n : sphere_normals()) {
    const glm::dvec3 about = glm::cross(glm::dvec3(0, 0, 1), n);
    const double sine = glm::length(about);
    for (const glm::dvec3& axis : facet_axes()) {
      const glm::dvec3 turned = turned_with_normal(axis, n);
      EXPECT_NEAR(glm::length(turned), 1.0, 1e-12);
      EXPECT_NEAR(glm::dot(turned, n), axis.z, 1e-12);  // as far from n as the axis is from z
      if (sine < 1e-12) continue;
      const glm::dvec3 expected = glm::angleAxis(std::atan2(sine, n.z), about / sine) * axis;
      EXPECT_LT(glm::length(turned - expected), 1e-9) << n.x << " " << n.y << " " << n.z;
    }
  }
}

TEST(FacetLobes, TheOppositeNormalTurnsAboutTheBitangent) {
  const glm::dvec3 turned = turned_with_normal({0.6, 0.48, 0.64}, {0, 0, -1});
  EXPECT_LT(glm::length(turned - glm::dvec3(-0.6, 0.48, -0.64)), 1e-15);
}

// Both axes lean by a slope of 0.75: half of its square an axis.
TEST(FacetLobes, WhoLeavesThemOutTakesTheirVarianceAboutTheNormal) {
  Material material;
  material.brdf.distribution = NormalDistribution::vmf;
  material.lobes = {{.axis = {0.6F, 0.0F, 0.8F}, .parameter = 60.0F, .weight = 0.75F},
                    {.axis = {0.0F, -0.6F, 0.8F}, .parameter = 20.0F, .weight = 0.5F}};
  const double own = (0.75 / 60 + 0.5 / 20) / 1.25;
  EXPECT_NEAR(mean_lobe_variance(material), own, 1e-6);
  EXPECT_NEAR(lobe_of(material).parameter, 1.0 / (own + 0.5 * 0.75 * 0.75), 1e-4);
}

TEST(FacetLobes, WhatIsNoLobeIsRefused) {
  const auto refused = [](const FacetLobe& lobe) {
    Material material;
    material.lobes = {lobe};
    EXPECT_THROW((void)facet_lobe_block(material), Error);
  };
  refused({.axis = {0, 0, 0}, .parameter = 0.2F, .weight = 1.0F});
  refused({.axis = {0.6F, 0, -0.8F}, .parameter = 0.2F, .weight = 1.0F});
  refused({.axis = {0, 0, 1}, .parameter = 0.0F, .weight = 1.0F});
  refused({.axis = {0, 0, 1}, .parameter = 0.2F, .weight = -1.0F});
  refused({.axis = {0, 0, 1}, .parameter = std::nanf(""), .weight = 1.0F});
  Material crowded;
  crowded.lobes.resize(most_facet_lobes + 1);
  EXPECT_THROW((void)facet_lobe_block(crowded), Error);
}

}  // namespace
}  // namespace footprint::testing
