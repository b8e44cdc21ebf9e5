// The ranks of methods, and sentences that claim no more than the figures support. Equivalent samples against curves
// whose answer is known in closed form.
#include "results/report/ranking.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "renderer/core/error.hpp"
#include "results/report/figures.hpp"
#include "tests/support/says.hpp"

namespace footprint {
namespace {

using test::says;

// A method of a distance, as far as the ranking looks at it.
Record method(const std::string& name, double shading, std::size_t interior = 5000, double distance = 1) {
  Record record;
  record.method = name;
  record.distance = distance;
  record.pixels = {.object = 8000, .interior = interior, .minified = interior, .bound = {}, .light = {}};
  record.error = RecordError{};
  record.error->normalized_color = 2 * shading;
  record.error->noise_floor = 0.002;
  record.error->causes = {
      .shading = shading, .shading_floor = 0.01, .shading_noise = 0.00025, .edges = 0.1 + shading, .light = {}};
  record.frame_ms = {2.0, 1.9, 2.2};
  record.ratio_to_direct = {1.3, 1.2, 1.4};
  return record;
}

Results run_of(std::vector<Record> records) {
  Results results;
  results.records = std::move(records);
  return results;
}

// All that is said of a distance, in one text.
std::string said(const Results& results, double distance = 1) {
  std::string text;
  for (const std::string& sentence : findings(results, distance)) text += sentence + "\n";
  return text;
}

std::string warned(const Results& results) {
  std::string text;
  for (const std::string& sentence : ranking_warnings(results)) text += sentence + "\n";
  return text;
}

TEST(Ranking, GoesByShadingAndSharesPlacesWithinTheNoise) {
  const Results results = run_of({method("d", 0.05), method("a", 0.02), method("b", 0.0209), method("c", 0.0305)});
  const DistanceRecords records = records_at(results, 1);
  EXPECT_EQ(rank(results.records[1], records), 1);
  EXPECT_EQ(rank(results.records[2], records), 1) << "0.0009 is under three standard errors, 0.00106";
  EXPECT_EQ(rank(results.records[3], records), 3);
  EXPECT_EQ(rank(results.records[0], records), 4);
  EXPECT_FALSE(is_better(results.records[1], results.records[2]));
  EXPECT_TRUE(is_better(results.records[1], results.records[3]));
  EXPECT_FALSE(is_better(results.records[3], results.records[1]));
}

TEST(Ranking, IsNotDoneOverTooFewPixels) {
  const Results results = run_of({method("a", 0.02, too_few_pixels - 1), method("b", 0.2, too_few_pixels - 1)});
  EXPECT_EQ(rank(results.records[0], records_at(results, 1)), std::nullopt);
  EXPECT_FALSE(is_better(results.records[0], results.records[1]));
  EXPECT_TRUE(says(said(results), "No method is ranked"));
  EXPECT_TRUE(says(warned(results), "At distance 1 there are fewer than 20 interior pixels"));
  EXPECT_TRUE(rank(method("a", 0.02, too_few_pixels), records_at(results, 1)).has_value());
}

TEST(Ranking, WithoutAnErrorThereIsNone) {
  Record record = method("a", 0.02);
  record.error.reset();
  EXPECT_EQ(ranked_error(record), std::nullopt);
  record = method("a", 0.02);
  record.error->causes.shading.reset();
  EXPECT_EQ(ranked_error(record), std::nullopt);
}

// Without an estimate of the noise no difference is certain.
TEST(Ranking, NeedsTheNoise) {
  Results results = run_of({method("a", 0.02), method("b", 0.9)});
  results.records[1].error->causes.shading_noise.reset();
  EXPECT_FALSE(is_better(results.records[0], results.records[1]));
  EXPECT_TRUE(says(warned(results), "raise --spp"));
}

TEST(RatioText, SaysAboutOneWhereTheSpreadCoversIt) {
  EXPECT_EQ(ratio_text({1.02, 0.95, 1.08}), "1.02 (0.950-1.08)");
  EXPECT_EQ(ratio_text({1.31, 1.25, 1.4}), "1.31 (1.25-1.40)");
  EXPECT_EQ(ratio_text({0.8, 0.7, 0.9}), "0.800 (0.700-0.900)");
  EXPECT_EQ(ratio_text({std::nan(""), std::nan(""), std::nan("")}), "n/a");
}

TEST(RankingWarnings, AreSilentWhereAllIsWell) {
  EXPECT_EQ(warned(run_of({method("a", 0.02), method("b", 0.05)})), "");
}

TEST(RankingWarnings, NameTheDistances) {
  const Results results =
      run_of({method("a", 0.02), method("b", 0.04), method("a", 0.02, 60, 4), method("b", 0.04, 60, 4),
              method("a", 0.02, 5, 16), method("b", 0.04, 5, 16), method("a", 0.02, 5, 32), method("b", 0.04, 5, 32)});
  EXPECT_TRUE(says(warned(results), "At distance 4 there are fewer than 100 interior pixels"));
  EXPECT_TRUE(says(warned(results), "At distances 16 and 32 there are fewer than 20"));
}

TEST(RankingWarnings, TellDifferencesBelowTheNoise) {
  EXPECT_TRUE(says(warned(run_of({method("a", 0.02), method("b", 0.0208)})), "raise --spp"));
  EXPECT_EQ(warned(run_of({method("a", 0.02)})), "") << "one method alone differs from none";
}

TEST(RankingWarnings, TellWhereNothingIsToBeFiltered) {
  Results results = run_of({method("a", 0.02), method("b", 0.04)});
  for (Record& record : results.records) record.pixels.minified = 0;
  EXPECT_TRUE(says(warned(results), "nothing needs filtering"));
  EXPECT_TRUE(says(said(results), "Nothing needs filtering here"));
}

TEST(RankingWarnings, TellAReferenceThatHasNotConverged) {
  Results results = run_of({method("a", 0.02), method("b", 0.04)});
  for (Record& record : results.records) record.error->causes.shading_floor = 0.0101;
  EXPECT_TRUE(says(warned(results), "At distance 1 the reference has not converged: its noise floor exceeds half"));
  for (Record& record : results.records) record.error->causes.shading_floor = 0.0099;
  EXPECT_EQ(warned(results), "");
}

// A few mirrors under small lights have most of the radiance; measures of displayed values do not see them.
TEST(RankingWarnings, LeaveVeryBrightPixelsToMeasuresOfLinearRadiance) {
  Results results = run_of({method("a", 0.02), method("b", 0.04)});
  results.reference.standard_errors = {11.0};
  EXPECT_EQ(warned(results), "");
  const std::string warning = linear_measures_warning(4, 11.0).value();
  EXPECT_TRUE(says(warning, "distance 4: measures of linear radiance"));
  EXPECT_TRUE(says(warning, "standard error is 11 of the mean radiance"));
  EXPECT_FALSE(linear_measures_warning(4, 0.4).has_value());
  EXPECT_FALSE(linear_measures_warning(4, {}).has_value());
}

TEST(Findings, NameTheBestAndThoseThatAreWorse) {
  const std::string text = said(run_of({method("direct", 0.09), method("toksvig", 0.02), method("lean", 0.05)}));
  EXPECT_TRUE(says(text, "toksvig has the smallest shading error: 0.02000 over 5000 interior pixels."));
  EXPECT_TRUE(says(text, "Significantly worse: lean (0.05000) and direct (0.09000)."));
  EXPECT_TRUE(says(text, "Edges make up 38% of the object's pixels; the error there is 0.12000 to 0.19000"));
}

TEST(Findings, ClaimNoWinnerWithinTheNoise) {
  const std::string text = said(run_of({method("lean", 0.0205), method("toksvig", 0.02), method("direct", 0.09)}));
  EXPECT_TRUE(says(text,
                   "toksvig and lean share the smallest shading error, 0.02000 to 0.02050 over 5000 interior pixels: "
                   "they differ by no more than the reference's noise."));
  EXPECT_FALSE(says(text, "toksvig has the smallest"));
}

TEST(Findings, SayWhatTheCheapestOfTheBestCosts) {
  Results results = run_of({method("lean", 0.0205), method("toksvig", 0.02), method("direct", 0.09)});
  results.records[0].frame_ms.median = 1.0;
  results.records[0].equivalent = EquivalentSamples{41.2, CurveSide::within};
  EXPECT_TRUE(
      says(said(results),
           "lean costs 1.30 (1.20-1.40) times as much as direct, and is as accurate as the mean of 41 frames of "
           "direct."));
  results.records[0].ratio_to_direct = {1.02, 0.9, 1.1};
  results.records[0].equivalent = EquivalentSamples{64, CurveSide::above};
  EXPECT_TRUE(says(
      said(results),
      "lean costs 1.02 (0.900-1.10) times as much as direct, and is as accurate as the mean of more than 64 frames "
      "of direct."));
  results.records[0].equivalent = EquivalentSamples{1, CurveSide::below};
  EXPECT_TRUE(says(said(results), "is less accurate than one frame of direct"));
}

// A method is not compared with itself.
TEST(Findings, SayNothingOfWhatDirectIsWorth) {
  Results results = run_of({method("direct", 0.02), method("toksvig", 0.09)});
  results.records[0].equivalent = EquivalentSamples{1, CurveSide::within};
  EXPECT_FALSE(says(said(results), "frames of direct"));
}

TEST(Findings, SayWhatTheBoundLeaves) {
  Results results = run_of({method("toksvig", 0.02), method("direct", 0.09)});
  EXPECT_FALSE(says(said(results), "exact normal distribution"));
  results.records[0].error->causes.filter = 0.015;
  results.records[0].error->causes.method = 0.008;
  results.records[0].pixels.bound = 1024;
  EXPECT_TRUE(says(said(results), "leaves an error of 0.01500"));
  EXPECT_TRUE(says(said(results), "toksvig differs from that result by 0.00800 (over 1024 pixels)"));
}

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
