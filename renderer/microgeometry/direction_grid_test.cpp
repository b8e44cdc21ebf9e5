// The map between square and hemisphere: golden points, the inverse, equal solid angle.
#include "renderer/microgeometry/direction_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace footprint {
namespace {

TEST(DirectionGrid, HasTheGoldenPoints) {
  struct Golden {
    glm::dvec3 direction;
    glm::dvec2 point;
  };
  const std::array<Golden, 5> golden{{{{0.0, 0.0, 1.0}, {0.5, 0.5}},
                                      {{0.3, 0.1, 0.9}, {0.6188945404026962, 0.5487069948366342}},
                                      {{-0.5, 0.2, 0.6}, {0.2471207835424442, 0.6225138521906438}},
                                      {{0.1, -0.7, 0.4}, {0.5643619020901106, 0.14375779444222608}},
                                      {{0.9, 0.1, 0.05}, {0.986021659846041, 0.5684771225797622}}}};
  for (const auto& [direction, point] : golden) {
    const glm::dvec2 found = hemisphere_to_square(glm::normalize(direction));
    EXPECT_NEAR(found.x, point.x, 1e-14);
    EXPECT_NEAR(found.y, point.y, 1e-14);
  }
}

TEST(DirectionGrid, TheMapsAreInverse) {
  for (const glm::dvec3& direction : direction_grid(37)) {
    EXPECT_NEAR(glm::length(direction), 1.0, 1e-14);
    EXPECT_LT(glm::length(square_to_hemisphere(hemisphere_to_square(direction)) - direction), 1e-13);
  }
}

// Means of z and z^2 over the hemisphere, by solid angle, are 1/2 and 1/3.
TEST(DirectionGrid, CellsHaveEqualSolidAngle) {
  double z = 0.0, z2 = 0.0;
  const std::vector<glm::dvec3> grid = direction_grid(200);
  for (const glm::dvec3& direction : grid) {
    z += direction.z;
    z2 += direction.z * direction.z;
  }
  EXPECT_NEAR(z / static_cast<double>(grid.size()), 1.0 / 2.0, 1e-4);
  EXPECT_NEAR(z2 / static_cast<double>(grid.size()), 1.0 / 3.0, 1e-4);
}

TEST(DirectionGrid, PutsWhatIsBelowTheHorizonOnTheRim) {
  const glm::dvec2 point = hemisphere_to_square(glm::normalize(glm::dvec3(0.8, 0.1, -0.4)));
  EXPECT_NEAR(std::max(std::abs(point.x - 0.5), std::abs(point.y - 0.5)), 0.5, 1e-12);
  EXPECT_EQ(hemisphere_to_square({0.0, 0.0, -1.0}), glm::dvec2(0.5));
}

// Bilinear on the square: a function that is linear on it comes back between the outermost centres.
TEST(DirectionGrid, InterpolatesBetweenCells) {
  constexpr int side = 5;
  for (const glm::dvec2 point : {glm::dvec2(0.1, 0.1), glm::dvec2(0.37, 0.81), glm::dvec2(0.9, 0.5), glm::dvec2(0.0),
                                 glm::dvec2(1.0), glm::dvec2(0.95, 0.02)}) {
    const GridCells around = cells_around(square_to_hemisphere(point), side);
    glm::dvec2 mean(0.0);
    double sum = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      ASSERT_LT(around.cells.at(k), 25U);
      mean += around.weights.at(k) * (glm::dvec2(around.cells.at(k) % side, around.cells.at(k) / side) + 0.5);
      sum += around.weights.at(k);
    }
    const glm::dvec2 clamped = glm::clamp(point * 5.0, 0.5, 4.5);
    EXPECT_NEAR(mean.x, clamped.x, 1e-9);
    EXPECT_NEAR(mean.y, clamped.y, 1e-9);
    EXPECT_NEAR(sum, 1.0, 1e-12);
  }
}

}  // namespace
}  // namespace footprint
