// An experiment's outcome as people read it, and what fell short of it.
#include "results/report/experiment_report.hpp"

#include <gtest/gtest.h>

#include "tests/report/example_results.hpp"
#include "tests/support/says.hpp"

namespace footprint {
namespace {

using test::says;

TEST(ExperimentSection, WhatFellShortIsListedWithItsFigures) {
  const std::vector<std::string> lines = example_results().experiment->shortfalls();
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0],
            "claim undecided: undecided, expected not reproduced: precompute(toksvig) < 300 (the bake came from the "
            "cache)");
  EXPECT_EQ(lines[1], "threshold error(direct): at most 0.02000, measured 0.02100");
  EXPECT_EQ(lines[2], "threshold flicker(direct): at most 0.02000, not measured: no figure");
}

TEST(ExperimentSection, MeasuredIsNextToPublished) {
  const std::string text = experiment_markdown(*example_results().experiment);
  EXPECT_TRUE(says(text, "| Figure 4   | fps(toksvig)        |   125 fps |  400 fps |")) << text;
  EXPECT_TRUE(says(text, "300 s |      n/a | from the cache")) << text;
  EXPECT_TRUE(says(text, "3 of 6 claims and thresholds failed, 1 undecided. Test run")) << text;
  EXPECT_TRUE(says(text, "error(toksvig) = 0.01100 \\*; error(direct) = 0.02100")) << text;
}

// Such a claim is undecided in the table, and its sentence has the machine, the figures and the estimate.
TEST(ExperimentSection, AClaimThatNothingHereDecidesSaysWhy) {
  const ExperimentReport report = *example_results().experiment;
  const std::string why = "Undecided: timed on llvmpipe, a software renderer.";
  for (const std::string& text : {experiment_markdown(report), experiment_html(report)}) {
    EXPECT_TRUE(says(text, "time(toksvig) = 4.00; time(direct) = 1.00")) << text;
    EXPECT_TRUE(says(text, "Estimated for Steam Deck: 0.30000 against 0.60000.")) << text;
    EXPECT_TRUE(says(text, why)) << text;
    EXPECT_FALSE(says(text, "time: undecided, expected")) << text;
  }
  EXPECT_TRUE(says(experiment_markdown(report), "4.00 |    1.00 | undecided")) << experiment_markdown(report);
}

TEST(ExperimentSection, AReasonIsGivenOnce) {
  ExperimentReport report = *example_results().experiment;
  report.claims.back().undecidable = report.claims.back().reason = "no measure is printed";
  const std::string text = experiment_markdown(report);
  EXPECT_EQ(text.find("no measure is printed"), text.rfind("no measure is printed")) << text;
}

TEST(ExperimentSection, TextOfOthersIsEscaped) {
  const ExperimentReport report = *hostile_results().experiment;
  EXPECT_FALSE(says(experiment_html(report), "<script>"));
  EXPECT_TRUE(says(experiment_markdown(report), "\\<script"));
  EXPECT_FALSE(says(experiment_markdown(report), " <script"));
  EXPECT_TRUE(says(experiment_html(report), "&lt;script&gt;"));
}

TEST(ExperimentSection, AnExperimentWithoutChecksSaysNothingOfThem) {
  ExperimentReport report;
  report.name = report.title = "bare";
  EXPECT_TRUE(report.shortfalls().empty());
  EXPECT_FALSE(says(experiment_markdown(report), "###"));
  EXPECT_FALSE(says(experiment_markdown(report), "claims and thresholds"));
  EXPECT_FALSE(says(experiment_html(report), "<table"));
}

}  // namespace
}  // namespace footprint
