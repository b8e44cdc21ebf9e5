// animation.json, animation.csv and the table of made-up frames.
#include "results/report/animation_report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/report/example_animation.hpp"

namespace footprint {
namespace {

Animation three_frames() {
  Animation animation = example_animation();
  animation.records[0].error.reset();
  return animation;
}

TEST(AnimationReport, JsonHasAllFrames) {
  const auto document = nlohmann::json::parse(animation_json(three_frames()));
  EXPECT_EQ(document.at("schema"), "footprint-animation/2");
  EXPECT_EQ(document.at("size"), nlohmann::json::array({64, 48}));
  ASSERT_EQ(document.at("records").size(), 6U);
  EXPECT_TRUE(document["records"][0]["error"].is_null());
  EXPECT_TRUE(document["records"][0]["flicker"].is_null());
  EXPECT_DOUBLE_EQ(document["records"][2]["flicker"]["mean"], 0.4);
  EXPECT_DOUBLE_EQ(document["records"][2]["flicker"]["edges"]["p99"], 0.6);
  EXPECT_TRUE(document["records"][2]["flicker"]["filter"].is_null());
  EXPECT_EQ(document["frames"].size(), 3U);
  EXPECT_DOUBLE_EQ(document["frames"][2]["degrees"], 20.0);
  EXPECT_EQ(document.at("axis"), nlohmann::json::array({0.0, 1.0, 0.0}));
}

TEST(AnimationReport, CsvHasALineARecordAndQuotesWhatItMust) {
  const std::string csv = animation_csv(three_frames());
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 7);
  EXPECT_NE(csv.find("0,1,0,a,,,,,,,,,,,,,,,,,,0.3,0.25,images/a_0000.exr\r\n"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\"b:x=1,\"\"y\"\"\""), std::string::npos) << csv;
}

TEST(AnimationReport, TheTableHasMeansOverTheFramesThatHaveTheFigure) {
  const std::string table = animation_table(three_frames());
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

}  // namespace
}  // namespace footprint
