// edit.json, edit.csv and the table of an edit.
#include "results/report/command_reports.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace footprint {
namespace {

EditRun two_edits() {
  EditRun run;
  run.scene.name = "woven_cloth";
  run.kind = "weave";
  run.method = "iwasaki_sg:j=4";
  run.size = {64, 48};
  run.records.push_back({.frame = 0,
                         .parameters = {{"height", "0.1"}, {"warp_width", "0.5"}},
                         .stages = {{"geometry", 0.001}, {"visibility", 0.02}, {"frame", 0.004}},
                         .bytes = 2048,
                         .notes = {"4 lobes, all \"seen\""},
                         .image = "images/iwasaki_0000.exr"});
  run.records.push_back({.frame = 1,
                         .parameters = {{"height", "0.1"}, {"warp_width", "0.25"}},
                         .stages = {{"geometry", 0.003}, {"frame", 0.005}, {"NDF", 0.002}},
                         .bytes = 2048,
                         .image = "images/iwasaki_0001.exr"});
  return run;
}

TEST(EditReport, JsonHasEveryFrameWithItsStages) {
  const nlohmann::json document = nlohmann::json::parse(edit_json(two_edits()));
  EXPECT_EQ(document["schema"], "footprint-edit/1");
  EXPECT_EQ(document["kind"], "weave");
  EXPECT_EQ(document["size"], nlohmann::json::array({64, 48}));
  ASSERT_EQ(document["records"].size(), 2U);
  const auto& record = document["records"][0];
  EXPECT_EQ(record["parameters"]["warp_width"], "0.5");
  EXPECT_DOUBLE_EQ(record["stage_ms"]["visibility"], 20.0);
  EXPECT_DOUBLE_EQ(record["edit_ms"], 25.0);
  EXPECT_EQ(record["notes"][0], "4 lobes, all \"seen\"");
}

TEST(EditReport, CsvLeavesAStageOutThatAFrameDoesNotHave) {
  EXPECT_EQ(edit_csv(two_edits()),
            "frame,weave.height,weave.warp_width,geometry_ms,visibility_ms,frame_ms,NDF_ms,edit_ms,bytes,image\r\n"
            "0,0.1,0.5,1,20,4,,25,2048,images/iwasaki_0000.exr\r\n"
            "1,0.1,0.25,3,,5,2,10,2048,images/iwasaki_0001.exr\r\n");
}

TEST(EditReport, TableHasMediansAndRate) {
  const std::string table = edit_table(two_edits());
  EXPECT_NE(table.find("| geometry   |      2.00 |    1.00 |    3.00 |"), std::string::npos) << table;
  EXPECT_NE(table.find("| edit       |      17.5 |    10.0 |    25.0 |"), std::string::npos) << table;
  EXPECT_NE(table.find("57.1 edits per second"), std::string::npos) << table;
  EXPECT_NO_THROW((void)edit_table({}));
}

}  // namespace
}  // namespace footprint
