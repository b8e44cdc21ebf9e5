// The table, the lines of results.csv and the caveats of made-up frames.
#include "results/report/report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "results/report/figures.hpp"
#include "results/report/ranking.hpp"
#include "results/report/results_table.hpp"
#include "tests/report/example_animation.hpp"

namespace footprint {
namespace {

Results three_frames() {
  Results animation = example_animation();
  animation.records[0].error.reset();
  return animation;
}

TEST(AnimationTable, JsonHasTheWayAndAllFrames) {
  const auto document = nlohmann::json::parse(results_json(three_frames()));
  EXPECT_EQ(document.at("way").at("path"), "orbit");
  EXPECT_EQ(document.at("way").at("axis"), nlohmann::json::array({0.0, 1.0, 0.0}));
  EXPECT_TRUE(document.at("film").is_null());
  ASSERT_EQ(document.at("records").size(), 6U);
  EXPECT_TRUE(document["records"][0]["error"].is_null());
  EXPECT_TRUE(document["records"][0]["flicker"].is_null());
  EXPECT_DOUBLE_EQ(document["records"][2]["flicker"]["mean"], 0.4);
  EXPECT_DOUBLE_EQ(document["records"][2]["flicker"]["edges"]["p99"], 0.6);
  EXPECT_TRUE(document["records"][2]["flicker"]["filter"].is_null());
  EXPECT_TRUE(document["records"][2]["time"]["fps"].is_null());
  EXPECT_DOUBLE_EQ(document["records"][4]["degrees"], 20.0);
}

TEST(AnimationTable, CsvHasALineARecordAndQuotesWhatItMust) {
  const std::string csv = results_csv(three_frames());
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 7);
  EXPECT_NE(csv.find("plane,a,,,1,10,0,1,64,48,0.2,"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",,0.2,0.2,0.6000000000000001,0.6000000000000001,,,,,0.3,0.25,"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\"b:x=1,\"\"y\"\"\""), std::string::npos) << csv;
}

TEST(AnimationTable, HasMeansOverTheFramesThatHaveTheFigure) {
  const std::string table = results_table(three_frames());
  EXPECT_NE(table.find("# plane, 3 frames: an orbit by 20 degrees at distance 1\n"), std::string::npos) << table;
  // a: errors 0.2 and 0.3; flicker 0.4 and 0.6 in the frames after the first
  EXPECT_NE(
      table.find("| a         | 0.25000 | 0.01000 | 0.50000 |     0.60000 |    0.75000 |           n/a |    0.30000 |"),
      std::string::npos)
      << table;
  EXPECT_NE(
      table.find("| a         | 0.25000 | 0.25000 | 0.75000 | 0.75000 |     n/a |     n/a |          n/a | n/a |"),
      std::string::npos)
      << table;
}

TEST(AnimationTable, NamesTheTimesOfAnAnimation) {
  Results animation = three_frames();
  animation.animation->path = "animation";
  for (Record& record : animation.records) record.seconds = 0.5 * record.frame;
  EXPECT_EQ(path_words(animation), "its animation from 0 to 1 s at distance 1");
}

TEST(AnimationTable, FramesThatTheReferencesNoiseExplainsAreCountedOnce) {
  Results animation = example_animation();
  EXPECT_TRUE(ranking_warnings(animation).empty());
  for (const std::size_t i : {2U, 3U, 4U}) animation.records[i].error->noise_floor = 0.29;
  const std::vector<std::string> warnings = ranking_warnings(animation);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_TRUE(warnings.front().starts_with("in 2 of 3 frames the reference has not converged")) << warnings.front();
  EXPECT_NE(results_table(animation).find("Warning: in 2 of 3 frames"), std::string::npos);
}

}  // namespace
}  // namespace footprint
