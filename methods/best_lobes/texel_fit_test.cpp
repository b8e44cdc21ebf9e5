// Lobes and their derivatives against twins and differences; fits of known lobes, and what every fit must keep.
#include "methods/best_lobes/lobe_shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace footprint::best_lobes {
namespace {

using enum NormalDistribution;
using fournier::Peak;

const std::vector<Lobe> base_lobes{{blinn_phong, 64.0}, {vmf, 30.0}, {beckmann, 0.25}, {ggx, 0.2}};

LobeFamily family_of(const Lobe& lobe, Shape shape) {
  return LobeFamily(lobe.distribution, lobe_variance(lobe), shape);
}

std::vector<std::vector<FittedLobe>> no_others(std::size_t) { return {}; }

Eigen::Vector3d tilted(double x, double y) { return {x, y, std::sqrt(1.0 - x * x - y * y)}; }

// Directions over the hemisphere at random, each with a solid angle of 1.
Directions random_directions(int count) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> unit(-0.7, 0.7);
  Directions out;
  for (int i = 0; i < count; ++i) {
    out.x.push_back(unit(random));
    out.y.push_back(unit(random));
    out.root_of_angle.push_back(1.0);
  }
  return out;
}

const FittedLobe wide{.weight = 1.0, .mean = {0.2, -0.15}, .deviation = 0.07, .root = {0.09, 0.02, 0.06}};

Eigen::VectorXd values_of(const LobeFamily& family, const FittedLobe& lobe, const Directions& directions) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(directions.size()));
  Eigen::MatrixXd derivatives(values.size(), family.parameters());
  family.evaluate(lobe, directions, values, derivatives);
  return values;
}

TEST(LobeShapes, DerivativesAreDifferences) {
  const Directions directions = random_directions(200);
  for (const Lobe& base : base_lobes) {
    for (const Shape shape : {Shape::round, Shape::stretched}) {
      const LobeFamily family = family_of(base, shape);
      Eigen::VectorXd values(200);
      Eigen::MatrixXd derivatives(200, family.parameters());
      family.evaluate(wide, directions, values, derivatives);
      for (Eigen::Index k = 0; k < family.parameters(); ++k) {
        constexpr double step = 1e-5;
        FittedLobe more = wide, less = wide;
        more.parameter(k) += step;
        less.parameter(k) -= step;
        const Eigen::VectorXd expected =
            (values_of(family, more, directions) - values_of(family, less, directions)) / (2.0 * step);
        EXPECT_GT(expected.norm(), 0.1) << "the gate: it depends on parameter " << k;
        EXPECT_LT((derivatives.col(k) - expected).norm(), 1e-5 * expected.norm())
            << lobe_text(base) << ", parameter " << k << ", shape " << static_cast<int>(shape);
      }
    }
  }
}

// Lobes of no spread, of either shape, are the base lobe.
TEST(LobeShapes, WithoutSpreadAreTheBaseLobe) {
  const Directions directions = random_directions(200);
  const FittedLobe narrow{.weight = 1.0, .mean = wide.mean};
  const Eigen::Vector3d axis = direction_from_plane(narrow.mean);
  for (const Lobe& base : base_lobes) {
    for (const Shape shape : {Shape::round, Shape::stretched}) {
      const Eigen::VectorXd values = values_of(family_of(base, shape), narrow, directions);
      for (std::size_t i = 0; i < directions.size(); ++i) {
        const Eigen::Vector3d h = direction_from_plane({directions.x[i], directions.y[i]});
        EXPECT_NEAR(values[static_cast<Eigen::Index>(i)], lobe_density(base, 0.5 * (h - axis).squaredNorm()),
                    1e-5 * lobe_peak(base))
            << lobe_text(base);
      }
    }
  }
}

const std::vector<Peak> four_normals{{0.4, tilted(0.0, 0.05), 0.0},
                                     {0.3, tilted(0.55, 0.1), 0.0},
                                     {0.2, tilted(-0.4, 0.4), 0.0},
                                     {0.1, tilted(-0.2, -0.5), 0.0}};

// Fitted although they need not be: the weights, the normals and no spread.
TEST(BestLobesFit, FindsAsManyNormalsAsLobes) {
  for (const Lobe& base : base_lobes) {
    for (const Shape shape : {Shape::round, Shape::stretched}) {
      const LobeFamily family = family_of(base, shape);
      const LobeFit fit = fit_lobes(four_normals, 4, family, no_others);
      EXPECT_LT(fit.error, 2e-3) << lobe_text(base);
      EXPECT_GT(fit_lobes(four_normals, 3, family, no_others).error, 0.02) << "the gate: three lobes are too few";
      ASSERT_EQ(fit.lobes.size(), 4U) << lobe_text(base);
      for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(fit.lobes[i].weight, four_normals[i].weight, 0.01) << lobe_text(base);
        EXPECT_LT((direction_from_plane(fit.lobes[i].mean) - four_normals[i].axis).norm(), 0.01) << lobe_text(base);
      }
    }
  }
}

// Normals at random, some in heaps: more of them than lobes.
std::vector<Peak> random_target(std::uint32_t seed, std::size_t count, double total) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Peak> target;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d heap(seed % 2 == 0 ? 0.3 * static_cast<double>(i % 3) : 0.0, 0.0);
    target.push_back({total / static_cast<double>(count),
                      tilted(heap.x() + 0.3 * unit(random), heap.y() + 0.15 * unit(random)), 0.0});
  }
  return target;
}

TEST(BestLobesFit, ErrsNoMoreWithMoreLobesAndKeepsTheWeight) {
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    const std::vector<Peak> target = random_target(seed, 24, 0.75);
    for (const Shape shape : {Shape::round, Shape::stretched}) {
      const LobeFamily family = family_of(base_lobes[seed % base_lobes.size()], shape);
      double before = 1.0;
      for (std::size_t count = 1; count <= 8; ++count) {
        const LobeFit fit = fit_lobes(target, count, family, no_others);
        EXPECT_LE(fit.error, before) << seed << ", " << count << " lobes";
        before = fit.error;
        double weight = 0.0;
        for (const FittedLobe& lobe : fit.lobes) {
          EXPECT_GE(lobe.weight, 0.0);
          weight += lobe.weight;
        }
        EXPECT_NEAR(weight, 0.75, 1e-9);
        EXPECT_TRUE(std::ranges::is_sorted(fit.lobes, std::greater{}, &FittedLobe::weight));
      }
      EXPECT_LT(before, 0.1) << seed;
    }
  }
}

TEST(BestLobesFit, StretchedLobesFitAStreakBetter) {
  std::vector<Peak> streak;
  for (int i = -10; i <= 10; ++i) streak.push_back({1.0, tilted(0.04 * i, 0.02 * i), 0.0});
  for (const Lobe& base : base_lobes) {
    const double round = fit_lobes(streak, 1, family_of(base, Shape::round), no_others).error;
    EXPECT_LT(fit_lobes(streak, 1, family_of(base, Shape::stretched), no_others).error, 0.6 * round) << lobe_text(base);
  }
}

// Lobes too narrow for the lattice, normals on the horizon and below it: finite, with all of the weight.
TEST(BestLobesFit, IsFiniteAtTheLimits) {
  const std::vector<Peak> edge{
      {0.5, {1.0, 0.0, 0.0}, 0.0}, {0.25, {0.0, 0.8, -0.6}, 0.0}, {0.25, {0.0, 0.0, 1.0}, 0.0}};
  std::vector<Peak> steep;
  for (int i = 0; i < 24; ++i)
    steep.push_back({1.0 / 24.0, tilted(0.999 * std::cos(i * i), 0.999 * std::sin(i * i)), 0.0});
  for (const Lobe& base : {Lobe{ggx, 0.001}, Lobe{blinn_phong, 1e6}, Lobe{blinn_phong, 1e-3}, Lobe{ggx, 1.0}}) {
    for (const Shape shape : {Shape::round, Shape::stretched}) {
      for (const std::vector<Peak>& target : {edge, steep}) {
        double weight = 0.0;
        for (const FittedLobe& lobe : fit_lobes(target, 2, family_of(base, shape), no_others).lobes) {
          EXPECT_TRUE(lobe.mean.allFinite() && lobe.spread().allFinite()) << lobe_text(base);
          EXPECT_LE(std::max(lobe.spread().maxCoeff(), std::abs(lobe.deviation)), 200.0) << lobe_text(base);
          weight += lobe.weight;
        }
        EXPECT_NEAR(weight, 1.0, 1e-9) << lobe_text(base);
      }
    }
  }
}

}  // namespace
}  // namespace footprint::best_lobes
