// The linear system of Eq. 8: golden condition numbers, duplicate lobes, non-negative solutions against brute force.
#include "methods/iwasaki_sg/lobe_fit.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "methods/iwasaki_sg/material_table.hpp"
#include "renderer/core/numbers.hpp"
#include "renderer/microgeometry/direction_grid.hpp"
#include "renderer/microgeometry/patch.hpp"

namespace footprint::iwasaki_sg {
namespace {

SphericalGaussian tilted(double sharpness, double radians) {
  return {{std::sin(radians), 0.0, std::cos(radians)}, sharpness};
}

TEST(Amplitudes, TwoLobesHaveTheGoldenConditionNumbers) {
  constexpr std::array<std::array<double, 2>, 6> golden{{{0.3, 1.980768821729142},
                                                         {0.1, 16.185701016354216},
                                                         {0.05, 64.6550896979556},
                                                         {0.01, 1616.1652914528504},
                                                         {0.001, 161616.16508823007},
                                                         {0.0001, 16161616.206872009}}};
  for (const auto& [angle, condition] : golden) {
    const std::array<SphericalGaussian, 2> lobes{tilted(50.0, 0.0), tilted(50.0, angle)};
    const Eigen::SelfAdjointEigenSolver<LobeMatrix> eigen(correlations(lobes));
    EXPECT_NEAR(eigen.eigenvalues()[1] / eigen.eigenvalues()[0] / condition, 1.0, 1e-5) << angle;
  }
}

// All active sets, one by one: the best that is feasible and optimal on its own support.
LobeVector best_by_enumeration(const LobeMatrix& a, const LobeVector& b) {
  const int n = static_cast<int>(b.size());
  LobeVector best = LobeVector::Zero(n);
  double least = 0.0;
  for (int set = 1; set < (1 << n); ++set) {
    std::vector<int> free;
    for (int i = 0; i < n; ++i) {
      if ((set >> i) & 1) free.push_back(i);
    }
    const auto m = static_cast<Eigen::Index>(free.size());
    Eigen::MatrixXd part(m, m);
    Eigen::VectorXd side(m);
    for (Eigen::Index i = 0; i < m; ++i) {
      side[i] = b[free[static_cast<std::size_t>(i)]];
      for (Eigen::Index j = 0; j < m; ++j) {
        part(i, j) = a(free[static_cast<std::size_t>(i)], free[static_cast<std::size_t>(j)]);
      }
    }
    const Eigen::VectorXd solution = part.inverse() * side;
    if ((solution.array() < 0.0).any()) continue;
    const double value = -0.5 * side.dot(solution);
    if (value >= least) continue;
    least = value;
    best.setZero();
    for (Eigen::Index i = 0; i < m; ++i) best[free[static_cast<std::size_t>(i)]] = solution[i];
  }
  return best;
}

TEST(Amplitudes, NonNegativeSolutionIsTheBestOfAllActiveSets) {
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 200; ++trial) {
    const int n = 2 + trial % 5;
    LobeMatrix a = LobeMatrix::Zero(n, n);
    LobeVector b(n);
    for (int k = 0; k < n + 1; ++k) {
      LobeVector row(n);
      for (int i = 0; i < n; ++i) row[i] = uniform(random) - 0.2;
      a += row * row.transpose();
    }
    a += 1e-3 * LobeMatrix::Identity(n, n);
    for (int i = 0; i < n; ++i) b[i] = uniform(random) - 0.4;
    EXPECT_LT((solve_non_negative(a, b) - best_by_enumeration(a, b)).norm(), 1e-8) << trial;
  }
}

struct Table {
  Bvndf bvndf;
  Amplitudes amplitudes;
  BvndfSums sums;
};

Table table_of(const Patch& patch, std::span<const SphericalGaussian> lobes, Energy energy, std::size_t facets = 4096) {
  Table out;
  out.bvndf = make_bvndf(patch, bin_facets(patch, sample_facets(patch, facets, 1)), direction_grid(6), no_progress);
  const std::array<PaintFactors, 1> white{};
  out.sums = sum_bvndf(out.bvndf, lobes, Cosines::published, 1, white, no_progress);
  out.amplitudes = solve_amplitudes(out.bvndf, out.sums, lobes, energy);
  return out;
}

// Sum of the masses of all lobes for each pair.
std::vector<double> mass_sums(const Amplitudes& table) {
  const std::size_t pairs = table.directions * table.directions;
  std::vector<double> sums(pairs);
  for (std::size_t i = 0; i < table.masses.size(); ++i) sums[i % pairs] += table.masses[i];
  return sums;
}

// Plain least squares solve Eq. 8 itself, with amplitudes below 0 where lobes overlap; bounded ones have none.
TEST(Amplitudes, OfAnySignSolveTheNormalEquations) {
  const std::vector<SphericalGaussian> lobes{{glm::normalize(glm::dvec3(0.2, 0.0, 1.0)), 6.0},
                                             {glm::normalize(glm::dvec3(-0.2, 0.1, 1.0)), 8.0},
                                             {{0.0, 0.0, 1.0}, 5.0}};
  const Patch patch = make_patch(find_patch_kind("pyramids"), {{"slope_degrees", "30"}});
  const Table free = table_of(patch, lobes, Energy::any_sign), bounded = table_of(patch, lobes, Energy::published);
  EXPECT_LT(*std::ranges::min_element(free.amplitudes.masses), -0.01F);
  EXPECT_GE(*std::ranges::min_element(bounded.amplitudes.masses), 0.0F);
  const std::size_t pairs = free.amplitudes.directions * free.amplitudes.directions;
  for (std::size_t pair = 0; pair < pairs; ++pair) {
    const double area = free.bvndf.visible_area[pair % free.amplitudes.directions];
    if (!(free.sums.totals[pair] > 0.0) || area < 1e-6 * free.bvndf.total_area()) continue;
    for (std::size_t i = 0; i < lobes.size(); ++i) {
      double left = 0.0;
      for (std::size_t j = 0; j < lobes.size(); ++j)
        left += convolution(lobes[i], lobes[j]) * free.amplitudes.masses[j * pairs + pair] /
                vmf_integral(lobes[j].sharpness);
      EXPECT_NEAR(left, free.sums.products[i * pairs + pair] / area, 2e-3 * (1.0 + left));  // the ridge's share
    }
  }
}

// A lobe given twice: finite, not negative, and the same in sum.
TEST(Amplitudes, DuplicateLobesShareWhatOneHas) {
  const Patch patch = make_patch(find_patch_kind("noise"), {{"slope", "0.3"}});
  const std::array<SphericalGaussian, 2> single{tilted(20.0, 0.1), tilted(40.0, -0.2)};
  const std::array<SphericalGaussian, 3> twice{single[0], single[0], single[1]};
  const std::vector<double> expected = mass_sums(table_of(patch, single, Energy::published).amplitudes);
  const Table doubled = table_of(patch, twice, Energy::published);
  const std::vector<double> found = mass_sums(doubled.amplitudes);
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(found[i], expected[i], 0.01 * expected[i] + 1e-9);
  for (const float mass : doubled.amplitudes.masses) ASSERT_TRUE(std::isfinite(mass) && mass >= 0.0F);
}

// Eq. 9 of the amplitudes is the sum of the BVNDF, k_d apart: to 0.1% where energy is conserved. Least squares alone is
// far from it on a V-groove with one lobe.
TEST(Amplitudes, ConservedEnergyMakesTheDiffuseTermExact) {
  const Patch patch = make_patch(find_patch_kind("grooves"), {{"land", "0"}});
  const std::array<SphericalGaussian, 1> lobe{tilted(5.0, 0.0)};
  double worst = 1.0;
  for (const Energy energy : {Energy::conserved, Energy::published}) {
    const Table table = table_of(patch, lobe, energy);
    const std::vector<double> found = mass_sums(table.amplitudes);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const double total = table.sums.totals[i] / table.bvndf.visible_area[i % table.sums.directions];
      if (total < 1e-3) continue;
      if (energy == Energy::conserved) {
        EXPECT_NEAR(found[i] / total, 1.0, 1e-3);
      } else {
        worst = std::min(worst, found[i] / total);
      }
    }
  }
  EXPECT_LT(worst, 0.9);
}

// A patch that hides all of itself from half of the directions.
TEST(Amplitudes, AreZeroWhereNothingIsSeen) {
  Patch patch;
  patch.name = "slats";
  patch.vertices = {{0.0F, 0.0F, 0.0F}, {0.5F, 0.0F, 2.0F}, {0.5F, 1.0F, 2.0F}, {0.0F, 1.0F, 0.0F}};
  patch.triangles = {{0, 1, 2}, {0, 2, 3}};
  const std::array<SphericalGaussian, 2> lobes{tilted(50.0, -1.2), tilted(5.0, 0.0)};
  const Table table = table_of(patch, lobes, Energy::conserved);
  const std::size_t n = table.sums.directions;
  std::size_t blind = 0;
  for (std::size_t o = 0; o < n; ++o) {
    if (table.bvndf.visible_area[o] > 0.0) continue;
    ++blind;
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_EQ(table.bvndf.gamma(0, i, o), 0.0);
      for (std::size_t j = 0; j < 2; ++j) EXPECT_EQ(table.amplitudes.masses[(j * n + i) * n + o], 0.0F);
    }
  }
  EXPECT_GT(blind, n / 4);
  for (const float mass : table.amplitudes.masses) ASSERT_TRUE(std::isfinite(mass) && mass >= 0.0F);
  for (const float value : table.amplitudes.diffuse) ASSERT_TRUE(std::isfinite(value) && value >= 0.0F);
}

}  // namespace
}  // namespace footprint::iwasaki_sg
