// Tables of a BRDF: the cell of two directions, against rotations by the angles that name it.
#include "renderer/microgeometry/microgeometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <utility>

namespace footprint {
namespace {

glm::dmat3 turned(double angle, const glm::dvec3& axis) {
  return glm::dmat3(glm::rotate(glm::dmat4(1.0), angle, axis));
}

// The directions to the light and to the viewer of three angles, as Rusinkiewicz (1998) builds them: both about z,
// phi_d turned, then the half vector tilted from the normal, along z, towards x.
std::pair<glm::dvec3, glm::dvec3> directions_of(const glm::dvec3& angles) {
  const glm::dmat3 tilt = turned(angles.x, {0, 1, 0}) * turned(angles.z, {0, 0, 1});
  const double sine = std::sin(angles.y), cosine = std::cos(angles.y);
  return {tilt * glm::dvec3(sine, 0, cosine), tilt * glm::dvec3(-sine, 0, cosine)};
}

// Each cell stores its own centre's angles, which come back from directions in any frame.
TEST(TabulatedBrdf, FindsTheCellOfTwoDirections) {
  const TabulatedBrdf table = tabulate([](const glm::dvec3& angles) { return glm::vec3(angles); });
  ASSERT_EQ(table.values.size(), TabulatedBrdf::cell_count);
  const glm::dmat3 frame = turned(0.7, glm::normalize(glm::dvec3(1, -2, 0.5)));
  for (const int h : {0, 1, 20, 60}) {
    for (const int d : {1, 7, 40}) {
      for (const int p : {0, 30, 89, 90, 150, 179}) {
        const glm::dvec3 angles = tabulated_angles(h, d, p);
        EXPECT_EQ(table.at(angles.x, angles.y, angles.z), glm::vec3(angles));
        EXPECT_EQ(table.at(angles.x, angles.y, angles.z + std::numbers::pi), glm::vec3(angles));
        const auto [wi, wo] = directions_of(angles);
        const glm::vec3 found = table.at(frame * glm::dvec3(0, 0, 1), frame * wi, frame * wo);
        EXPECT_EQ(found, glm::vec3(angles)) << h << " " << d << " " << p;
      }
    }
  }
}

// Narrow cells near the specular direction: theta_h goes with the square of the cell, 0 to 90 degrees (Matusik et al.
// 2003).
TEST(TabulatedBrdf, HalfAnglesGoByTheirRoot) {
  EXPECT_NEAR(tabulated_angles(0, 0, 0).x, 0.5 * std::numbers::pi * 0.25 / 8100.0, 1e-12);
  EXPECT_NEAR(tabulated_angles(89, 0, 0).x, 0.5 * std::numbers::pi * 89.5 * 89.5 / 8100.0, 1e-12);
  EXPECT_NEAR(tabulated_angles(0, 45, 90).y, 0.25 * std::numbers::pi * 91.0 / 90.0, 1e-12);
  EXPECT_NEAR(tabulated_angles(0, 45, 90).z, 0.5 * std::numbers::pi * 181.0 / 180.0, 1e-12);
}

TEST(TabulatedBrdf, NothingIsReflectedStraightOn) {
  const TabulatedBrdf table = tabulate([](const glm::dvec3&) { return glm::vec3(1.0F); });
  EXPECT_EQ(table.at({0, 0, 1}, {1, 0, 0}, {-1, 0, 0}), glm::vec3(0.0F));
  EXPECT_EQ(table.at({0, 0, 1}, {0, 0, 1}, {0, 0, 1}), glm::vec3(1.0F));
}

}  // namespace
}  // namespace footprint
