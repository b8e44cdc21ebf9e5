// Equivalent samples against curves whose answer is known in closed form.
#include "results/report/equivalent_spp.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

/// Monte Carlo: error = 0.2 / sqrt(spp).
std::vector<CurvePoint> square_root_curve() {
  std::vector<CurvePoint> curve;
  for (const int spp : {1, 2, 4, 8, 16, 32, 64}) curve.push_back({double(spp), 0.2 / std::sqrt(spp)});
  return curve;
}

TEST(EquivalentSpp, InvertsThePowerLawBetweenItsPoints) {
  for (const double spp : {1.5, 3.0, 5.0, 11.3, 41.0, 63.0}) {
    const EquivalentSamples found = equivalent_samples(square_root_curve(), 0.2 / std::sqrt(spp));
    ASSERT_TRUE(found.spp.has_value());
    EXPECT_NEAR(*found.spp, spp, 1e-9 * spp);
    EXPECT_EQ(found.bound, "");
  }
}

TEST(EquivalentSpp, MeasuredPointsGiveTheirOwnCount) {
  EXPECT_DOUBLE_EQ(equivalent_samples(square_root_curve(), 0.2).spp.value(), 1.0);
  EXPECT_DOUBLE_EQ(equivalent_samples(square_root_curve(), 0.1).spp.value(), 4.0);
  EXPECT_DOUBLE_EQ(equivalent_samples(square_root_curve(), 0.2 / 8).spp.value(), 64.0);
}

TEST(EquivalentSpp, BoundsNameTheEndsOfTheCurve) {
  const EquivalentSamples worse = equivalent_samples(square_root_curve(), 0.21);
  EXPECT_FALSE(worse.spp.has_value());
  EXPECT_EQ(worse.bound, "<1");
  EXPECT_EQ(equivalent_samples(square_root_curve(), 0.02).bound, ">64");
  EXPECT_EQ(equivalent_samples(square_root_curve(), 0.0).bound, ">64");
  const std::vector<CurvePoint> coarse{{2, 0.3}, {16, 0.1}};
  EXPECT_EQ(equivalent_samples(coarse, 0.4).bound, "<2");
  EXPECT_EQ(equivalent_samples(coarse, 0.05).bound, ">16");
  EXPECT_EQ(equivalent_samples({}, 0.1).bound, "n/a");
}

TEST(EquivalentSpp, ACurveThatRisesAgainCountsToTheLastCrossing) {
  const std::vector<CurvePoint> noisy{{1, 0.4}, {2, 0.1}, {4, 0.2}, {8, 0.05}};
  // 0.15 is crossed three times; the last time between 4 and 8: 0.2 * 4^-(log2(n / 4)) = 0.15.
  const double expected = 4.0 * std::pow(2.0, std::log(0.2 / 0.15) / std::log(4.0));
  EXPECT_NEAR(equivalent_samples(noisy, 0.15).spp.value(), expected, 1e-12);
  const std::vector<CurvePoint> rising{{1, 0.4}, {2, 0.1}, {4, 0.2}};
  EXPECT_EQ(equivalent_samples(rising, 0.15).bound, ">4");
}

TEST(EquivalentSpp, MoreErrorIsNeverWorthMore) {
  const std::vector<CurvePoint> noisy{{1, 0.4}, {2, 0.1}, {4, 0.2}, {8, 0.05}, {16, 0.06}, {32, 0.01}};
  double previous = std::numeric_limits<double>::infinity();
  for (double error = 0.011; error < 0.4; error += 0.001) {
    const double spp = equivalent_samples(noisy, error).spp.value();
    EXPECT_LE(spp, previous) << "at error " << error;
    previous = spp;
  }
}

TEST(EquivalentSpp, ZeroErrorsStayFinite) {
  const std::vector<CurvePoint> exact_at_four{{1, 0.2}, {4, 0.0}};
  EXPECT_NEAR(equivalent_samples(exact_at_four, 0.1).spp.value(), 2.0, 1e-12);
  EXPECT_DOUBLE_EQ(equivalent_samples(exact_at_four, 0.0).spp.value(), 4.0);
  const std::vector<CurvePoint> flat_map{{1, 0.0}, {64, 0.0}};
  EXPECT_DOUBLE_EQ(equivalent_samples(flat_map, 0.0).spp.value(), 64.0);
  EXPECT_EQ(equivalent_samples(flat_map, 1e-9).bound, "<1");
}

TEST(EquivalentSpp, RefusesFiguresThatAreNoErrors) {
  EXPECT_THROW((void)equivalent_samples(square_root_curve(), std::nan("")), Error);
  EXPECT_THROW((void)equivalent_samples(square_root_curve(), -0.1), Error);
  EXPECT_THROW((void)equivalent_samples(std::vector<CurvePoint>{{0, 0.1}}, 0.1), Error);
  EXPECT_THROW((void)equivalent_samples(std::vector<CurvePoint>{{1, INFINITY}}, 0.1), Error);
}

TEST(EquivalentSpp, PicksOneDistanceInAnyOrder) {
  const std::vector<SupersamplingPoint> points{
      {4, 16, 0.05, 9}, {1, 1, 0.9, 1}, {4, 1, 0.2, 2}, {4, 64, std::nullopt, 30}, {4, 4, 0.1, 4}};
  const std::vector<CurvePoint> curve = supersampling_curve(points, 4);
  ASSERT_EQ(curve.size(), 3U);
  EXPECT_NEAR(equivalent_samples(curve, 0.1).spp.value(), 4.0, 1e-12);
  EXPECT_EQ(equivalent_samples(curve, 0.01).bound, ">16");
}

}  // namespace
}  // namespace footprint
