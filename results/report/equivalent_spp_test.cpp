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

/// The samples that an error within the curve is worth.
double within(std::span<const CurvePoint> curve, double error) {
  const std::optional<EquivalentSamples> found = equivalent_samples(curve, error);
  EXPECT_TRUE(found && found->side == CurveSide::within) << "at error " << error;
  return found ? found->spp : std::nan("");
}

/// That an error is beyond the end `spp` of the curve.
void expect_beyond(std::span<const CurvePoint> curve, double error, CurveSide side, double spp) {
  const std::optional<EquivalentSamples> found = equivalent_samples(curve, error);
  ASSERT_TRUE(found) << "at error " << error;
  EXPECT_EQ(found->side, side) << "at error " << error;
  EXPECT_EQ(found->spp, spp) << "at error " << error;
}

TEST(EquivalentSpp, InvertsThePowerLawBetweenItsPoints) {
  for (const double spp : {1.5, 3.0, 5.0, 11.3, 41.0, 63.0}) {
    EXPECT_NEAR(within(square_root_curve(), 0.2 / std::sqrt(spp)), spp, 1e-9 * spp);
  }
}

TEST(EquivalentSpp, MeasuredPointsGiveTheirOwnCount) {
  EXPECT_DOUBLE_EQ(within(square_root_curve(), 0.2), 1.0);
  EXPECT_DOUBLE_EQ(within(square_root_curve(), 0.1), 4.0);
  EXPECT_DOUBLE_EQ(within(square_root_curve(), 0.2 / 8), 64.0);
}

TEST(EquivalentSpp, BoundsNameTheEndsOfTheCurve) {
  expect_beyond(square_root_curve(), 0.21, CurveSide::below, 1);
  expect_beyond(square_root_curve(), 0.02, CurveSide::above, 64);
  expect_beyond(square_root_curve(), 0.0, CurveSide::above, 64);
  const std::vector<CurvePoint> coarse{{2, 0.3}, {16, 0.1}};
  expect_beyond(coarse, 0.4, CurveSide::below, 2);
  expect_beyond(coarse, 0.05, CurveSide::above, 16);
  EXPECT_FALSE(equivalent_samples({}, 0.1).has_value());
}

TEST(EquivalentSpp, ACurveThatRisesAgainCountsToTheLastCrossing) {
  const std::vector<CurvePoint> noisy{{1, 0.4}, {2, 0.1}, {4, 0.2}, {8, 0.05}};
  // 0.15 is crossed three times; the last time between 4 and 8: 0.2 * 4^-(log2(n / 4)) = 0.15.
  const double expected = 4.0 * std::pow(2.0, std::log(0.2 / 0.15) / std::log(4.0));
  EXPECT_NEAR(within(noisy, 0.15), expected, 1e-12);
  const std::vector<CurvePoint> rising{{1, 0.4}, {2, 0.1}, {4, 0.2}};
  expect_beyond(rising, 0.15, CurveSide::above, 4);
}

TEST(EquivalentSpp, MoreErrorIsNeverWorthMore) {
  const std::vector<CurvePoint> noisy{{1, 0.4}, {2, 0.1}, {4, 0.2}, {8, 0.05}, {16, 0.06}, {32, 0.01}};
  double previous = std::numeric_limits<double>::infinity();
  for (double error = 0.011; error < 0.4; error += 0.001) {
    const double spp = within(noisy, error);
    EXPECT_LE(spp, previous) << "at error " << error;
    previous = spp;
  }
}

TEST(EquivalentSpp, ZeroErrorsStayFinite) {
  const std::vector<CurvePoint> exact_at_four{{1, 0.2}, {4, 0.0}};
  EXPECT_NEAR(within(exact_at_four, 0.1), 2.0, 1e-12);
  EXPECT_DOUBLE_EQ(within(exact_at_four, 0.0), 4.0);
  const std::vector<CurvePoint> flat_map{{1, 0.0}, {64, 0.0}};
  EXPECT_DOUBLE_EQ(within(flat_map, 0.0), 64.0);
  expect_beyond(flat_map, 1e-9, CurveSide::below, 1);
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
  EXPECT_NEAR(within(curve, 0.1), 4.0, 1e-12);
  expect_beyond(curve, 0.01, CurveSide::above, 16);
}

}  // namespace
}  // namespace footprint
