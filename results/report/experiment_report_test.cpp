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
  EXPECT_TRUE(says(text, "3 of 5 claims and thresholds failed. Test run")) << text;
  EXPECT_TRUE(says(text, "error(toksvig) = 0.01100 \\*; error(direct) = 0.02100")) << text;
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
