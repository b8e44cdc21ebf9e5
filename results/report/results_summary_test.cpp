// The output of a terminal: the answer, and a table that starts with the least error.
#include "results/report/results_table.hpp"

#include <gtest/gtest.h>

#include "tests/report/example_results.hpp"
#include "tests/support/says.hpp"

namespace footprint {
namespace {

using test::says;

Record row(const std::string& method, double error, double cost, double noise = 0.0001) {
  Record record;
  record.method = method;
  record.distance = 2;
  record.width = record.height = 64;
  record.pixels = {.object = 800, .interior = 500, .minified = 500, .bound = {}, .light = {}};
  record.error = RecordError{};
  record.error->causes = {.shading = error, .shading_floor = 0.0001, .shading_noise = noise, .edges = {}, .light = {}};
  record.frame_ms = {cost, cost, cost};
  record.ratio_to_direct = {cost, 0.9 * cost, 1.1 * cost};
  record.precompute_bytes = 1 << 20;
  return record;
}

Results run_of(std::vector<Record> records) {
  Results results;
  results.scene.name = "plane";
  results.supersampling = {{2, 1, 0.2, 0.2, 1.0, "m"}};
  results.records = std::move(records);
  return results;
}

TEST(ResultsSummary, AnswersBeforeTheTable) {
  const std::string text =
      results_summary(run_of({row("direct", 0.2, 1), row("cheap", 0.1, 1.2), row("best", 0.05, 3)}));
  EXPECT_TRUE(says(text,
                   "Distance 2: best is the most accurate: error 0.05000 (-75% against direct), at 3.00 times the "
                   "frame time of direct.\n    cheap is the cheapest that improves on direct: error 0.10000, at 1.20"));
  EXPECT_LT(text.find("most accurate"), text.find("Memory"));
  const std::size_t table = text.find("Memory");
  EXPECT_LT(text.find("best", table), text.find("cheap", table));
  EXPECT_LT(text.find("cheap", table), text.find("direct", table));
}

TEST(ResultsSummary, AHistoryOfDirectIsComparedWithItsSingleFrame) {
  Record history = row("direct", 0.05, 2);
  history.history = {.frames = 24, .alpha = 0.1, .clamp = HistoryClamp::off, .jitter = true};
  EXPECT_TRUE(says(results_summary(run_of({history, row("a", 0.1, 3)})),
                   "direct is the most accurate: error 0.05000 (-75% against direct), at 2.00 times the frame time"));
}

TEST(ResultsSummary, NamesAllThatNoiseLeavesAlike) {
  const std::string text = results_summary(run_of({row("a", 0.1, 2, 0.01), row("b", 0.101, 1.5, 0.01)}));
  EXPECT_TRUE(says(text,
                   "a, b are the most accurate, with no difference beyond the reference's noise: error 0.10000 to "
                   "0.10100 (-50% against direct), at 1.50 times the frame time of direct with b."));
}

TEST(ResultsSummary, FailedAndUnrankedRowsComeLast) {
  Record failed = row("broken", 0.01, 1);
  failed.error.reset();
  failed.failure = "out of memory";
  const std::string text = results_summary(run_of({failed, row("a", 0.1, 2)}));
  const std::size_t table = text.find("Memory");
  EXPECT_LT(text.find("  a ", table), text.find("broken", table));
  EXPECT_TRUE(says(text, "failed"));
  EXPECT_TRUE(says(results_summary(run_of({failed})), "no method is ranked"));
}

TEST(ResultsSummary, RoundsSecondsToHundredths) {
  std::vector<Record> rows{row("a", 0.1, 1), row("b", 0.2, 1), row("c", 0.3, 1)};
  rows[0].precompute_seconds = 0.0004;
  rows[1].precompute_seconds = 1.4142;
  rows[2].precompute_seconds = 31.42;
  const std::string text = results_summary(run_of(rows));
  for (const char* seconds : {"  <0.01 s\n", "   1.41 s\n", "   31.4 s\n"}) EXPECT_TRUE(says(text, seconds));
}

TEST(ResultsSummary, ColumnsAlign) {
  const std::string text = results_summary(example_results());
  EXPECT_TRUE(says(text, "Distance  Method"));
  EXPECT_TRUE(says(text, "= supersampling at"));
}

}  // namespace
}  // namespace footprint
