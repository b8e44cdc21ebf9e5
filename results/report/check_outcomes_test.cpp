// Checks for other programs: JUnit XML, annotations, baselines, each shown what must fall.
#include "results/report/experiment_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/core/error.hpp"
#include "tests/support/says.hpp"

namespace footprint {
namespace {

using test::says;
using ::testing::IsEmpty;
using ::testing::SizeIs;

ClaimOutcome claim(const std::string& name, const std::string& inequality, Verdict outcome) {
  ClaimOutcome claim;
  claim.name = name;
  claim.inequality = inequality;
  claim.outcome = outcome;
  claim.place = name == "good" ? "a,b/mine.toml:3" : "a,b/mine.toml:6";
  return claim;
}

ThresholdOutcome threshold(const std::string& measure, double measured) {
  return {.measure = measure, .limit = 0.5, .measured = measured, .problem = {}, .place = "a,b/mine.toml:8"};
}

ExperimentReport report() {
  ExperimentReport report;
  report.name = "mine";
  report.file = "a,b/mine.toml";
  report.claims = {claim("good", "1 < 2", Verdict::reproduced),
                   claim("bad", "error(a) < \"2\" & 3", Verdict::not_reproduced)};
  report.thresholds = {threshold("error(a)", 0.25), threshold("error(b)", 0.75)};
  return report;
}

TEST(CheckOutcomes, AreClaimsAndThresholdsWithTheirPlaces) {
  const std::vector<CheckOutcome> outcomes = check_outcomes(report());
  ASSERT_THAT(outcomes, SizeIs(4));
  EXPECT_THAT(outcomes[0].failure, IsEmpty());
  EXPECT_EQ(outcomes[0].place, "a,b/mine.toml:3");
  EXPECT_EQ(outcomes[1].place, "a,b/mine.toml:6");
  EXPECT_THAT(outcomes[2].failure, IsEmpty());
  EXPECT_EQ(outcomes[3].place, "a,b/mine.toml:8");
  EXPECT_TRUE(says(outcomes[3].failure, "at most 0.50000, measured 0.75000"));
  EXPECT_EQ(shortfalls_of(outcomes), report().shortfalls());
  EXPECT_THAT(shortfalls_of(outcomes), SizeIs(2));
}

TEST(CheckOutcomes, JunitCountsAndEscapes) {
  std::vector<CheckOutcome> outcomes = check_outcomes(report());
  outcomes.push_back({.suite = "<other>", .name = "claim \x01", .failure = ""});
  const std::string xml = junit_xml(outcomes);
  EXPECT_TRUE(says(xml, "<testsuites tests=\"5\" failures=\"2\">"));
  EXPECT_TRUE(says(xml, "<testsuite name=\"mine\" tests=\"4\" failures=\"2\">"));
  EXPECT_TRUE(says(xml, "<testsuite name=\"&lt;other&gt;\" tests=\"1\" failures=\"0\">"));
  EXPECT_TRUE(says(xml, "<testcase classname=\"mine\" name=\"claim good\"/>"));
  EXPECT_TRUE(says(xml, "error(a) &lt; &quot;2&quot; &amp; 3"));
  EXPECT_EQ(xml.find('\x01'), std::string::npos);
}

// A figure that decides nothing is no failure, whatever is expected; a missing figure is one.
TEST(CheckOutcomes, WhatNothingHereDecidesIsSkipped) {
  ExperimentReport timed = report();
  timed.claims.back().outcome = Verdict::undecided;
  EXPECT_THAT(timed.shortfalls(), SizeIs(2)) << "undecided for no reason";
  timed.claims.back().undecidable = "timed on \"llvmpipe\"";
  EXPECT_THAT(timed.shortfalls(), SizeIs(1));
  const std::string xml = junit_xml(check_outcomes(timed));
  EXPECT_TRUE(says(xml, "<testsuites tests=\"4\" failures=\"1\" skipped=\"1\">")) << xml;
  EXPECT_TRUE(says(xml, "<testsuite name=\"mine\" tests=\"4\" failures=\"1\" skipped=\"1\">")) << xml;
  EXPECT_TRUE(says(xml, "<skipped message=\"timed on &quot;llvmpipe&quot;\"/>")) << xml;
  EXPECT_FALSE(says(github_annotations(check_outcomes(timed)), "claim bad"));
  timed.claims.back().problem = "no record has this figure";
  EXPECT_THAT(timed.shortfalls(), SizeIs(2));
  EXPECT_FALSE(says(junit_xml(check_outcomes(timed)), "<skipped"));
}

TEST(CheckOutcomes, NothingIsExpectedOfAMachineThatDecides) {
  ExperimentReport timed = report();
  timed.claims.back().expect = Verdict::undecided;
  EXPECT_THAT(timed.shortfalls(), SizeIs(1)) << "the threshold alone";
}

TEST(CheckOutcomes, AnnotationsAreOfWhatFellShort) {
  const std::string text = github_annotations(check_outcomes(report()));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2);
  EXPECT_TRUE(says(text, "::error file=a%2Cb/mine.toml,line=6,title=mine%3A claim bad::"));
  EXPECT_TRUE(says(text, "::error file=a%2Cb/mine.toml,line=8,title=mine%3A threshold error(b)::at most 0.5"));
}

BaselineFigures figures(double error, double bytes) {
  return {{"mine", {{"a at 1", {{"error", error}, {"bytes", bytes}}}}}};
}

TEST(Baseline, ComesBackAsItWasWritten) {
  const Baseline written{.tolerance = 0.25, .figures = figures(0.1, 1024)};
  const Baseline read = parse_baseline(baseline_json(written), "file");
  EXPECT_EQ(read.tolerance, written.tolerance);
  EXPECT_EQ(read.figures, written.figures);
}

TEST(Baseline, DifferencesWithinTheTolerancePass) {
  const Baseline baseline{.tolerance = 1e-4, .figures = figures(0.1, 1024)};
  for (const double error : {0.1, 0.10009, 0.09991}) {
    const auto outcomes = compare_with_baseline(baseline, figures(error, 1024), "file");
    ASSERT_THAT(outcomes, SizeIs(1));
    EXPECT_THAT(outcomes[0].failure, IsEmpty());
  }
}

TEST(Baseline, WhatDiffersFallsShort) {
  const Baseline baseline{.tolerance = 1e-4, .figures = figures(0.1, 1024)};
  const auto failure = [&](const BaselineFigures& now) {
    std::string text;
    for (const CheckOutcome& outcome : compare_with_baseline(baseline, now, "file")) text += outcome.failure;
    return text;
  };
  EXPECT_TRUE(says(failure(figures(0.1002, 1024)), "error 0.1002, was 0.1"));
  EXPECT_TRUE(says(failure(figures(0.1, 1025)), "bytes 1025, was 1024"));
  EXPECT_TRUE(says(failure({{"mine", {{"a at 1", {{"bytes", 1024}}}}}}), "error is missing, was 0.1"));
  EXPECT_TRUE(says(failure({{"mine", {}}}), "this record is missing in the run"));
  EXPECT_TRUE(says(failure({{"another", {{"a at 1", {}}}}}), "this record is missing in the baseline"));
}

TEST(Baseline, AnExperimentThatWasNotRunIsNotLookedAt) {
  EXPECT_THAT(compare_with_baseline({.tolerance = 0, .figures = figures(0.1, 1)}, {}, "file"), IsEmpty());
}

TEST(Baseline, OtherFilesAreRefused) {
  for (const std::string text :
       {"", "[]", "{}", R"({"schema": "footprint-results/2"})", R"({"schema": "footprint-baseline/1"})",
        R"({"schema": "footprint-baseline/1", "tolerance": -1, "figures": {}})",
        R"({"schema": "footprint-baseline/1", "tolerance": 0, "figures": {"a": 3}})"})
    EXPECT_THROW((void)parse_baseline(text, "file"), Error) << text;
}

}  // namespace
}  // namespace footprint
