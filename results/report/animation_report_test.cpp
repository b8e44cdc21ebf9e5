// animation.json, animation.csv and the table of made-up frames.
#include "results/report/animation_report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace footprint {
namespace {

AnimationRecord record_of(int frame, const std::string& method, double error) {
  AnimationRecord record{.frame = frame,
                         .distance = 1.0 + frame,
                         .method = method,
                         .normalized_color = error,
                         .noise_floor = 0.01,
                         .flicker = {},
                         .image = "images/x.exr"};
  if (frame > 0) record.flicker = Flicker{.mean = 2 * error, .p99 = 3 * error, .noise_floor = {}};
  return record;
}

Animation three_frames() {
  Animation animation;
  animation.scene.name = "plane";
  animation.width = 4;
  animation.height = 3;
  animation.reference_images = {"images/reference_0000.exr", "images/reference_0001.exr", "images/reference_0002.exr"};
  for (int frame = 0; frame < 3; ++frame) {
    animation.records.push_back(record_of(frame, "a", 0.1 * (frame + 1)));
    animation.records.push_back(record_of(frame, "b:x=1,\"y\"", 0.3));
  }
  animation.records[0].normalized_color.reset();
  return animation;
}

TEST(AnimationReport, JsonHasAllFrames) {
  const auto document = nlohmann::json::parse(animation_json(three_frames()));
  EXPECT_EQ(document.at("schema"), "footprint-animation/1");
  EXPECT_EQ(document.at("size"), nlohmann::json::array({4, 3}));
  ASSERT_EQ(document.at("records").size(), 6U);
  EXPECT_TRUE(document["records"][0]["normalized_color"].is_null());
  EXPECT_TRUE(document["records"][0]["flicker"].is_null());
  EXPECT_DOUBLE_EQ(document["records"][2]["flicker"]["mean"], 0.4);
  EXPECT_EQ(document["reference_images"].size(), 3U);
}

TEST(AnimationReport, CsvHasALineARecordAndQuotesWhatItMust) {
  const std::string csv = animation_csv(three_frames());
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 7);
  EXPECT_NE(csv.find("0,1,a,,0.01,,,,images/x.exr\r\n"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\"b:x=1,\"\"y\"\"\""), std::string::npos) << csv;
}

TEST(AnimationReport, TheTableHasMeansOverTheFramesThatHaveTheFigure) {
  const std::string table = animation_table(three_frames());
  // a: errors 0.2 and 0.3; flicker 0.4 and 0.6 in the frames after the first
  EXPECT_NE(table.find("| a         | 0.25000 | 0.01000 | 0.50000 |     0.60000 |    0.75000 |           n/a |"),
            std::string::npos)
      << table;
}

}  // namespace
}  // namespace footprint
