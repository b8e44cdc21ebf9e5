// The plane of the lattice against its definition, reach against closed forms, and the extent of a lattice.
#include "methods/ndf_atlas/atlas.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace footprint::ndf_atlas {
namespace {

using enum NormalDistribution;
using std::numbers::pi;

glm::dvec3 polar(double tilt, double azimuth) {
  return {std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), std::cos(tilt)};
}

Facets facets_of_normals(std::vector<glm::vec3> normals, const Lobe& lobe) {
  const auto width = static_cast<int>(normals.size());
  return {.width = width,
          .height = 1,
          .distribution = lobe.distribution,
          .normals = std::move(normals),
          .parameters = {static_cast<float>(lobe.parameter)}};
}

TEST(Plane, IsInvertedByDirections) {
  for (const double tilt : {0.0, 0.3, 1.2, 0.5 * pi, 2.5, 3.1}) {
    const glm::dvec3 n = polar(tilt, 0.7);
    EXPECT_NEAR(glm::length(direction_over(plane_of(n)) - n), 0.0, 1e-12) << tilt;
  }
  EXPECT_NEAR(glm::length(plane_of(polar(0.5 * pi, 2.0))), std::numbers::sqrt2, 1e-12) << "the horizon";
  EXPECT_NEAR(direction_over({3.0, 0.0}).z, -1.0, 1e-12) << "beyond the sphere";
}

// The area of a small square of directions is its solid angle, anywhere.
TEST(Plane, KeepsAreas) {
  for (const double tilt : {0.2, 0.9, 1.5, 2.6}) {
    constexpr double h = 1e-4;
    const glm::dvec2 at = plane_of(polar(tilt, 0.4));
    const glm::dvec2 along = plane_of(polar(tilt + h, 0.4)) - at;
    const glm::dvec2 across = plane_of(polar(tilt, 0.4 + h)) - at;
    EXPECT_NEAR((along.x * across.y - along.y * across.x) / (h * h * std::sin(tilt)), 1.0, 1e-3) << tilt;
  }
}

TEST(Reach, IsThatOfTheClosedForms) {
  constexpr double outside = 1e-3;
  for (const double s : {8.0, 64.0, 1e4, 1e6}) {  // cos^(s + 1) is outside
    EXPECT_NEAR(lobe_reach({blinn_phong, s}, outside) / std::acos(std::pow(outside, 1.0 / (s + 1.0))), 1.0, 0.01) << s;
  }
  for (const double kappa : {20.0, 1e5}) {  // e^{kappa (cos - 1)}
    EXPECT_NEAR(lobe_reach({vmf, kappa}, outside) / std::acos(1.0 + std::log(outside) / kappa), 1.0, 0.01) << kappa;
  }
  EXPECT_GT(lobe_reach({ggx, 0.1}, outside), 1.2) << "a long tail";
  EXPECT_NEAR(lobe_reach({vmf, 1e-3}, outside), pi, 0.1);
}

TEST(Lattice, CoversEveryLobeInSteps) {
  const std::vector<glm::vec3> normals{glm::vec3(polar(0.2, 0.1)), glm::vec3(polar(0.5, 3.0)), glm::vec3(0.0F)};
  for (const Lobe& lobe : {Lobe{blinn_phong, 64.0}, Lobe{beckmann, 0.1}, Lobe{ggx, 0.3}, Lobe{vmf, 500.0}}) {
    const Lattice lattice = lattice_over(facets_of_normals(normals, lobe), 0.73);
    EXPECT_LE(std::max(lattice.step.x, lattice.step.y), 0.73 * lobe_width(lobe) * (1.0 + 1e-12));
    const double reach = lobe_reach(lobe, energy_outside);
    for (const std::size_t i : {0U, 1U}) {
      for (int k = 0; k < 16; ++k) {
        const double angle = 2.0 * pi * k / 16.0;
        const glm::dvec3 n(normals[i]);
        const glm::dvec3 u = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), n));
        const glm::dvec3 side = std::cos(angle) * u + std::sin(angle) * glm::cross(n, u);
        const glm::dvec3 h = std::cos(reach) * n + std::sin(reach) * side;
        if (h.z < 0.0) continue;
        const glm::dvec2 node = (plane_of(h) - lattice.origin) / lattice.step;
        EXPECT_GE(std::min(node.x, node.y), -1e-9);
        EXPECT_LE(node.x, lattice.nodes.x - 1 + 1e-9);
        EXPECT_LE(node.y, lattice.nodes.y - 1 + 1e-9);
      }
    }
  }
}

TEST(Lattice, IsAsFineAsTheNarrowestAndAsWideAsTheWidest) {
  Facets facets = facets_of_normals({glm::vec3(0, 0, 1), glm::vec3(0, 0, 1)}, {blinn_phong, 64.0});
  const Lattice narrow = lattice_over(facets, 0.73);
  facets.parameters = {64.0F, 16.0F};
  const Lattice both = lattice_over(facets, 0.73);
  EXPECT_NEAR(both.step.x, narrow.step.x, 0.15 * narrow.step.x);
  EXPECT_GT(both.nodes.x, 1.8 * narrow.nodes.x);
}

TEST(Lattice, SaysHowManyNodesAMirrorTakesAndStopsBelowTheHorizon) {
  std::vector<glm::vec3> normals;
  for (int i = 0; i < 8; ++i) normals.emplace_back(polar(1.4, 0.25 * pi * i));
  EXPECT_GT(lattice_over(facets_of_normals(normals, {blinn_phong, 1e6}), 0.73).nodes.x, 3000);
  const Lattice wide = lattice_over(facets_of_normals(normals, {vmf, 2.0}), 0.73);
  EXPECT_LE(-wide.origin.x, std::numbers::sqrt2 + 2.0 * 0.73 / std::sqrt(2.0) + 1e-9);
  const Lattice none = lattice_over(facets_of_normals({glm::vec3(0.0F)}, {vmf, 2.0}), 0.73);
  EXPECT_EQ(none.nodes, glm::ivec2(2)) << "nothing to cover";
}

}  // namespace
}  // namespace footprint::ndf_atlas
