// table.md and the wording of figures.
#include <gtest/gtest.h>

#include <sstream>

#include "results/report/figures.hpp"
#include "results/report/page.hpp"
#include "results/report/report.hpp"
#include "results/report/results_table.hpp"
#include "tests/report/example_results.hpp"
#include "tests/support/says.hpp"

namespace footprint {
namespace {

using test::says;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(Figures, NumbersReadTheSameEverywhere) {
  EXPECT_EQ(error_text(0.0123456), "0.01235");
  EXPECT_EQ(error_text(0.0000123), "1.2e-05");
  EXPECT_EQ(error_text(0), "0");
  EXPECT_EQ(error_text(std::nan("")), "n/a");
  EXPECT_EQ(three_figures(1.3), "1.30");
  EXPECT_EQ(three_figures(99.94), "99.9");
  EXPECT_EQ(three_figures(99.96), "100");
  EXPECT_EQ(three_figures(12345.6), "12346");
  EXPECT_EQ(three_figures(0), "0.00");
  EXPECT_EQ(spread_text(1.31, 1.25, 1.4), "1.31 (1.25-1.40)");
}

TEST(MarkdownTable, ColumnsAlignAndMarkupIsEscaped) {
  const std::string text =
      markdown_table({.columns = {{"Name", false}, {"ms"}}, .rows = {{"a|b", "1.25"}, {"µ <b> <1 x *", "10"}}});
  EXPECT_EQ(text,
            "| Name          |   ms |\n"
            "|:--------------|-----:|\n"
            "| a\\|b          | 1.25 |\n"
            "| µ \\<b> <1 x * |   10 |\n");
}

TEST(ResultsTable, FitsATerminalAndAligns) {
  const std::string table = results_table(example_results());
  std::size_t width = 0;
  for (const std::string& line : lines_of(table)) {
    EXPECT_LE(line.size(), 130U) << line;
    if (line.starts_with('|') && width != 0) {
      EXPECT_EQ(line.size(), width) << line;
    }
    width = line.starts_with('|') ? line.size() : 0;
  }
}

TEST(ResultsTable, LongMethodNamesSplitIt) {
  Results results = example_results();
  results.records[3].method = "toksvig:storage=unorm8:normalization=beckmann:probes=16";
  for (const std::string& line : lines_of(results_table(results))) {
    if (line.starts_with('|')) {
      EXPECT_LE(line.size(), 130U) << line;
    }
  }
}

TEST(ResultsTable, ComparesEveryTwoMethodsPixelByPixel) {
  Results results = example_results();
  const std::string table = results_table(results);
  EXPECT_TRUE(says(table, "| % of pixels closer than | direct | naive_mip | toksvig | toksvig:storage=unorm8 |"));
  EXPECT_TRUE(says(table, "| naive_mip               |   20.0 |         - |     5.0 |                    5.0 |"));
  EXPECT_TRUE(says(table, "toksvig is closer to the reference than"));
  results.pairs.clear();  // of a reference that does not know its noise
  EXPECT_FALSE(says(results_table(results), "| % of pixels"));
}

TEST(ResultsTable, SaysWhatWasMeasuredAndUnderWhatConditions) {
  const std::string table = results_table(example_results());
  for (const char* part : {"llvmpipe", "AMD EPYC", "0.840 (automatic)", "256 samples per pixel", "after_shading",
                           "seed 7", "a rig of two lights", "KHR_materials_clearcoat", "## Distance 16",
                           "Plain supersampling", "roughness_variation", "16.0 MiB", "0.31"}) {
    EXPECT_TRUE(says(table, part)) << part;
  }
  EXPECT_TRUE(says(table, "4.0e-04 *")) << "a shading error below the noise floor carries the mark";
  EXPECT_TRUE(says(table, "60 !")) << "few pixels carry their mark";
  EXPECT_EQ(lines_of(table).front(), "# ClearCoatTest");
}

// Warnings on the ranking come before any figure.
TEST(ResultsTable, WarningsStandAboveIt) {
  const std::string table = results_table(example_results());
  const std::size_t warnings = table.find("## Caveats");
  ASSERT_NE(warnings, std::string::npos);
  EXPECT_LT(warnings, table.find("## Distance 1"));
  EXPECT_TRUE(says(table, "At distance 16 there are fewer than 20 interior pixels"));
  EXPECT_TRUE(says(table, "12345 object pixels, 9260 of them interior (75%); noise floor 0.00071, "));
}

TEST(ResultsTable, HasAColumnForLightWhereThereIsOne) {
  Results results = example_results();
  EXPECT_TRUE(says(results_table(results), "Light |"));
  results.records[1].error->causes.light.reset();
  EXPECT_FALSE(says(results_table(results), "Light |"));
}

TEST(ResultsTable, NamesCannotBreakIt) {
  const Results results = hostile_results();
  const std::string table = results_table(results);
  EXPECT_FALSE(says(table, " <img"));
  EXPECT_TRUE(says(table, "\\<img src=x"));
  EXPECT_FALSE(says(table, "n/a (")) << "figures that were not measured have no spread";
  EXPECT_TRUE(says(table, "\\[link](javascript"));
}

}  // namespace
}  // namespace footprint
