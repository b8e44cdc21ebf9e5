// Triangles over polygons: their areas have one sign and sum to the polygon's, whatever its shape and place.
#include "renderer/scene/obj/polygon.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace footprint {
namespace {

using Polygon = std::vector<glm::dvec3>;

// Half of the sum of cross products about the origin (Newell).
glm::dvec3 area_vector(const Polygon& polygon) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < polygon.size(); ++i) sum += glm::cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return 0.5 * sum;
}

void expect_covered(const Polygon& polygon) {
  const std::vector<std::uint32_t> triangles = triangulated(polygon);
  ASSERT_EQ(triangles.size(), 3 * (polygon.size() - 2));
  const glm::dvec3 whole = area_vector(polygon);
  double sum = 0.0;
  for (std::size_t i = 0; i < triangles.size(); i += 3) {
    const Polygon triangle{polygon.at(triangles[i]), polygon.at(triangles[i + 1]), polygon.at(triangles[i + 2])};
    const double part = glm::dot(area_vector(triangle), glm::normalize(whole));
    EXPECT_GE(part, -1e-9 * glm::length(whole));
    sum += std::abs(part);
  }
  EXPECT_NEAR(sum, glm::length(whole), 1e-9 * glm::length(whole));
}

// Every start, both windings, and turned into other planes.
void expect_covered_anyhow(const Polygon& flat) {
  for (std::size_t first = 0; first < flat.size(); ++first) {
    Polygon turned, back;
    for (std::size_t i = 0; i < flat.size(); ++i) {
      const glm::dvec3 p = flat[(first + i) % flat.size()];
      turned.emplace_back(100.0 + p.y, 0.3 * p.x - 0.4 * p.y, p.x);
      back.insert(back.begin(), p);
    }
    expect_covered(turned);
    expect_covered(back);
  }
}

TEST(Polygon, KeepsTheFanWhereItCovers) {
  const Polygon pentagon{{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {1, 3, 0}, {-1, 1, 0}};
  EXPECT_TRUE(is_fan(pentagon));
  EXPECT_EQ(triangulated(pentagon), (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3, 0, 3, 4}));
  const Polygon arrow{{0.5, 0.2, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}};  // about its inner corner
  EXPECT_EQ(triangulated(arrow), (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3, 0, 3, 4}));
}

TEST(Polygon, CoversCombsSpiralsAndHolesJoinedByAnEdge) {
  Polygon comb{{0, -1, 0}, {10, -1, 0}};
  for (int tooth = 9; tooth >= 0; --tooth) {
    comb.emplace_back(tooth + 0.9, 3.0, 0.0);
    comb.emplace_back(tooth + 0.1, 0.0, 0.0);
  }
  expect_covered_anyhow(comb);
  Polygon spiral;
  for (int i = 0; i < 40; ++i)
    spiral.emplace_back((1.0 + 0.2 * i) * std::cos(0.5 * i), (1.0 + 0.2 * i) * std::sin(0.5 * i), 0.0);
  for (int i = 39; i >= 0; --i)
    spiral.emplace_back((0.8 + 0.2 * i) * std::cos(0.5 * i), (0.8 + 0.2 * i) * std::sin(0.5 * i), 0.0);
  expect_covered_anyhow(spiral);
  expect_covered_anyhow(
      {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0}, {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}});
}

TEST(Polygon, CoversStarsOfRandomRadii) {
  std::mt19937 random(7);
  for (int round = 0; round < 200; ++round) {
    const int count = 4 + static_cast<int>(random() % 20);
    Polygon star;
    for (int i = 0; i < count; ++i) {
      const double angle = 6.283185307179586 * i / count, radius = 0.1 + 1e-3 * static_cast<double>(random() % 1000);
      star.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    }
    expect_covered_anyhow(star);
  }
}

TEST(Polygon, EndsForPolygonsThatHaveNoArea) {
  EXPECT_EQ(triangulated(Polygon(5, glm::dvec3(1.0))).size(), 9U);
  EXPECT_EQ(triangulated(Polygon{{0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {2, 0, 0}}).size(), 6U);
  EXPECT_EQ(triangulated(Polygon{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {3, 0.5, 0}}).size(),
            9U);  // crosses itself
  EXPECT_THROW((void)triangulated(Polygon(2)), std::logic_error);
}

}  // namespace
}  // namespace footprint
