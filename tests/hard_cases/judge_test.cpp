// Verdicts on figures within and beyond their bounds, with and without a known limit, and their lines on the page.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "methods/registry.hpp"
#include "tests/hard_cases/hard_report.hpp"
#include "tests/hard_cases/known_limits.hpp"
#include "tests/hard_cases/worst.hpp"

namespace footprint::hard_cases {
namespace {

constexpr KnownLimit limits[] = {
    {.method = "wide", .hard_case = "groove", .figure = "energy", .most = 0.5, .why = "one lobe"},
    {.method = "thin:storage=fp16",
     .hard_case = "groove",
     .figure = "energy",
     .most = 0.3,
     .guarded = true,
     .why = "clamp"},
    {.method = "", .hard_case = "groove", .figure = "twin", .most = 0.2, .why = "shared by all"}};

HardRow judged(const std::string& method, double value, const std::string& figure = "energy", bool whole = true) {
  HardRow row{method, "groove", "bumps", "a groove", figure, value, 0.1};
  judge(row, limits, whole);
  return row;
}

TEST(Judge, ChecksABound) {
  EXPECT_EQ(judged("other", 0.1).verdict, Verdict::passed);
  EXPECT_EQ(judged("other", 0.11).verdict, Verdict::failed);
  EXPECT_EQ(judged("other", std::numeric_limits<double>::quiet_NaN()).verdict, Verdict::failed);
  EXPECT_EQ(judged("other", std::numeric_limits<double>::infinity()).verdict, Verdict::failed);
}

TEST(Judge, KnowsHowFarALimitReaches) {
  EXPECT_EQ(judged("wide", 0.4).verdict, Verdict::out_of_range);
  EXPECT_EQ(judged("wide:storage=fp16", 0.4).verdict, Verdict::out_of_range);
  EXPECT_EQ(judged("wide", 0.6).verdict, Verdict::failed);
  EXPECT_EQ(judged("wide", std::numeric_limits<double>::quiet_NaN()).verdict, Verdict::failed);
  EXPECT_EQ(judged("wide", 0.4, "limit").verdict, Verdict::failed) << "of another figure";
  EXPECT_EQ(judged("widest", 0.4).verdict, Verdict::failed) << "another method";
  EXPECT_EQ(judged("thin:storage=fp16", 0.2).verdict, Verdict::guarded);
  EXPECT_EQ(judged("thin", 0.2).verdict, Verdict::failed) << "of one storage alone";
}

TEST(Judge, ALimitThatPassesUnexpectedlyFails) {
  EXPECT_EQ(judged("wide", 0.05).verdict, Verdict::failed);
  EXPECT_EQ(judged("wide:storage=fp16", 0.05).verdict, Verdict::passed) << "the method's own is still out of range";
  EXPECT_EQ(judged("wide", 0.05, "energy", false).verdict, Verdict::passed) << "limits of another renderer";
  EXPECT_EQ(judged("wide", 0.4, "energy", false).verdict, Verdict::out_of_range);
  EXPECT_EQ(judged("wide", 0.6, "energy", false).verdict, Verdict::failed);
}

TEST(Judge, KnowsOfLimitsOfEveryMethod) {
  EXPECT_EQ(judged("other:storage=fp16", 0.15, "twin").verdict, Verdict::out_of_range);
  EXPECT_EQ(judged("new", 0.25, "twin").verdict, Verdict::failed);
  EXPECT_EQ(judged("new", 0.15).verdict, Verdict::failed) << "of another figure";
}

TEST(KeepWorst, NothingHidesANaN) {
  double worst = 0.0;
  for (const double value : {0.2, 0.3, 0.1}) keep_worst(worst, value);
  EXPECT_EQ(worst, 0.3);
  keep_worst(worst, std::numeric_limits<double>::quiet_NaN());
  keep_worst(worst, 0.1);
  EXPECT_TRUE(std::isnan(worst));
}

TEST(StabilityPage, ReportsNothingAsPassedUntested) {
  std::vector<HardRow> rows{judged("other", 0.05), judged("wide", 0.4), judged("worse", 0.9)};
  rows.push_back({"other", "smooth", "sizes", "a map", "finite", 0.0, 0.0});
  const std::string page = stability_page(rows);
  EXPECT_NE(page.find("| `other` | passed | passed |"), std::string::npos) << page;
  EXPECT_NE(page.find("| `wide` | 1 out of range | not tested |"), std::string::npos) << page;
  EXPECT_NE(page.find("| `worse` | 1 failed | not tested |"), std::string::npos) << page;
  EXPECT_NE(page.find("| `wide` | `groove` | energy | 0.4 | 0.1 | one lobe |"), std::string::npos) << page;
  ASSERT_EQ(failures_of(rows).size(), 1U);
  EXPECT_EQ(failures_of(rows).front(), "worse, groove, energy: 0.9 is over 0.1");
}

// A method's claims on its storages agree with the known limits: no narrow lobe is off under fp16.
TEST(KnownLimits, HaveNoStorageThatLeavesLobesAsGiven) {
  std::size_t claims = 0;
  for (const Method* const method : all_methods()) {
    if (!method->info.lobes_as_given) continue;
    ++claims;
    const std::string text = method->info.name + ":storage=";
    for (const KnownLimit& limit : known_limits()) EXPECT_FALSE(limit.method.starts_with(text)) << limit.method;
  }
  EXPECT_GT(claims, 0U);
}

}  // namespace
}  // namespace footprint::hard_cases
