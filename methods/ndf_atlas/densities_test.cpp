// Tables against plain sums over texels, at every level and size; what the second differences buy.
#include "methods/ndf_atlas/atlas.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace footprint::ndf_atlas {
namespace {

using std::numbers::pi;
constexpr double exponent = 64.0;

Facets random_facets(int width, int height, std::uint32_t seed) {
  Facets facets{.width = width, .height = height, .normals = {}, .parameters = {static_cast<float>(exponent)}};
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> lean(-0.5F, 0.5F);
  for (int i = 0; i < width * height; ++i) {
    const float x = lean(random);
    const float y = lean(random);
    facets.normals.push_back(i % 11 == 3 ? glm::vec3(0.0F) : glm::normalize(glm::vec3(x, y, 1.0F)));
  }
  return facets;
}

// (s + 1) / 2 pi cos^s, straight from vectors.
double lobe_at(const glm::dvec3& n, const glm::dvec3& h) {
  return (exponent + 1.0) / (2.0 * pi) * std::pow(std::max(glm::dot(n, h), 0.0), exponent);
}

// The mean over the valid texels of a block.
double block_density(const Facets& facets, const glm::ivec2& corner, int edge, const glm::dvec3& h) {
  double sum = 0.0;
  double count = 0.0;
  for (int y = corner.y; y < std::min(corner.y + edge, facets.height); ++y) {
    for (int x = corner.x; x < std::min(corner.x + edge, facets.width); ++x) {
      const glm::dvec3 n(facets.normals[static_cast<std::size_t>(y * facets.width + x)]);
      if (glm::length(n) == 0.0) continue;
      sum += lobe_at(n, h);
      count += 1.0;
    }
  }
  return sum / count;
}

double largest_error(const Facets& facets, const Lattice& lattice, const LevelTables& tables, int edge) {
  double most = 0.0;
  for (int y = 0; y < tables.height; ++y) {
    for (int x = 0; x < tables.width; ++x) {
      const auto table = tables.table(static_cast<std::size_t>(y * tables.width + x));
      for (int j = 0; j < lattice.nodes.y; j += 3) {
        for (int i = 0; i < lattice.nodes.x; i += 3) {
          const glm::dvec3 h = direction_over(lattice.point(i, j));
          const double found = table[static_cast<std::size_t>(j * lattice.nodes.x + i)];
          most = std::max(most, std::abs(found - block_density(facets, {x * edge, y * edge}, edge, h)));
        }
      }
    }
  }
  return most;
}

TEST(Densities, AreTheSumsOverTexelsAtEveryLevel) {
  const Facets facets = random_facets(16, 8, 5);
  const Lattice lattice = lattice_over(facets, 0.73);
  LevelTables level = build_tables(facets, lattice, 1, no_progress);
  const double peak = (exponent + 1.0) / (2.0 * pi);
  for (int edge = 2; edge <= 16; edge *= 2) {
    EXPECT_LT(largest_error(facets, lattice, level, edge), 2e-3 * peak) << edge << ": what a lobe's reach leaves out";
    level = coarser(level);
  }
  EXPECT_EQ(level.coverage.size(), 1U);
  EXPECT_NEAR(level.coverage[0], 1.0 - 12.0 / 128.0, 1e-6);
}

// Sizes that are no power of two: straight to a level, or by the levels between.
TEST(Densities, AreTheSameByAnyRoadToALevel) {
  const Facets facets = random_facets(13, 7, 8);
  const Lattice lattice = lattice_over(facets, 0.73);
  LevelTables stepped = build_tables(facets, lattice, 1, no_progress);
  for (int level = 2; level < 4; ++level) {
    stepped = coarser(stepped);
    const LevelTables straight = build_tables(facets, lattice, level, no_progress);
    ASSERT_EQ(stepped.density.size(), straight.density.size());
    for (std::size_t i = 0; i < straight.coverage.size(); ++i)
      EXPECT_NEAR(stepped.coverage[i], straight.coverage[i], 1e-6);
    for (std::size_t i = 0; i < straight.density.size(); ++i)
      EXPECT_NEAR(stepped.density[i], straight.density[i], 1e-4 * (exponent + 1.0) / (2.0 * pi));
  }
  EXPECT_LT(largest_error(facets, lattice, stepped, 13), 2e-3 * (exponent + 1.0) / (2.0 * pi)) << "all texels alike";
}

TEST(Densities, AreTheSameWithOneThread) {
  const Facets facets = random_facets(32, 32, 2);
  const Lattice lattice = lattice_over(facets, 0.73);
  const LevelTables tables = build_tables(facets, lattice, 2, no_progress);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(build_tables(facets, lattice, 2, no_progress).density, tables.density);
  EXPECT_EQ(coarser(tables).density, coarser(tables).density);
}

// What a bilinear lookup of a table differs by from the sum over texels, relative L2 over the plane.
double bilinear_error(const Facets& facets, const Lattice& lattice, std::span<const float> table) {
  double squares = 0.0;
  double norm = 0.0;
  const auto at = [&](int i, int j) {
    return static_cast<double>(table[static_cast<std::size_t>(j * lattice.nodes.x + i)]);
  };
  for (double y = 0.05; y < lattice.nodes.y - 1; y += 0.31) {
    for (double x = 0.05; x < lattice.nodes.x - 1; x += 0.31) {
      const glm::dvec2 point = lattice.origin + lattice.step * glm::dvec2(x, y);
      if (glm::length(point) > std::numbers::sqrt2) continue;
      const int i = static_cast<int>(x);
      const int j = static_cast<int>(y);
      const double found = (1 - y + j) * ((1 - x + i) * at(i, j) + (x - i) * at(i + 1, j)) +
                           (y - j) * ((1 - x + i) * at(i, j + 1) + (x - i) * at(i + 1, j + 1));
      const double exact = block_density(facets, {0, 0}, 16, direction_over(point));
      squares += (found - exact) * (found - exact);
      norm += exact * exact;
    }
  }
  return std::sqrt(squares / norm);
}

// Second differences take away more than half of what bilinear lookups are off by, and keep the sum.
TEST(Densities, AreCloserWithSecondDifferences) {
  const Facets facets = random_facets(4, 4, 9);
  const Lattice lattice = lattice_over(facets, 0.73);
  const LevelTables tables = build_tables(facets, lattice, 2, no_progress);
  std::vector<float> corrected(tables.table(0).begin(), tables.table(0).end());
  correct_for_bilinear(corrected, lattice);
  const double error = bilinear_error(facets, lattice, corrected);
  const double plain = bilinear_error(facets, lattice, tables.table(0));
  EXPECT_LT(error, 0.03);
  EXPECT_GT(plain, 2.0 * error) << "the gate: node values as they are";
  double sum = 0.0;
  double plain_sum = 0.0;
  for (std::size_t k = 0; k < corrected.size(); ++k) {
    sum += static_cast<double>(corrected[k]);
    plain_sum += static_cast<double>(tables.table(0)[k]);
    EXPECT_GE(corrected[k], 0.0F);
  }
  EXPECT_NEAR(sum / plain_sum, 1.0, 1e-3);
}

// Beyond the lattice a lookup has its border's value: 0, except where the border is below the horizon.
TEST(Densities, EndAtTheBorderAboveTheHorizon) {
  const Lattice lattice{.nodes = {4, 3}, .origin = {0.5, -0.4}, .step = {0.4, 0.4}};  // to x = 1.7
  std::vector<float> table(12, 1.0F);
  close_border(table, lattice);
  const std::vector<float> expected{0, 0, 0, 1, 0, 1, 1, 1, 0, 0, 0, 1};
  EXPECT_EQ(table, expected);
}

}  // namespace
}  // namespace footprint::ndf_atlas
