// Counts, sentences and maps of claims whose outcomes over a grid are known.
#include "results/report/region_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace footprint {
namespace {

using testing::HasSubstr;

constexpr Verdict yes = Verdict::reproduced, no = Verdict::not_reproduced, open = Verdict::undecided;

// A grid of three distances by two storages, and one claim.
RegionReport grid(std::vector<Verdict> outcomes, Verdict stated = no) {
  RegionReport report{.title = "a <figure>"};
  report.axes = {{"distance", {"1", "2", "4"}}, {"lean", {"lean:storage=fp32", "lean:storage=fp16"}}};
  for (const std::string& distance : report.axes[0].values) {
    for (const std::string& method : report.axes[1].values)
      report.settings.push_back({"s", {{"distance", distance}, {"lean", method}}});
  }
  report.claims.push_back({.name = "under", .text = "It is lower.", .stated = stated, .outcomes = std::move(outcomes)});
  return report;
}

std::string sentence(std::vector<Verdict> outcomes, Verdict stated = no) {
  const RegionReport report = grid(std::move(outcomes), stated);
  return region_sentence(report, report.claims.front());
}

TEST(Region, SentencesNameWhatRestrictsAClaim) {
  EXPECT_EQ(sentence({yes, yes, yes, no, no, no}),
            "True in 3 of 6 settings, all of them with distance 1 or 2; at the stated setting it is false.");
  EXPECT_EQ(
      sentence({no, yes, no, yes, no, no}),
      "True in 2 of 6 settings, all of them with distance 1 or 2 and lean:storage=fp16; at the stated setting it is "
      "false.");
  EXPECT_EQ(sentence({yes, no, no, yes, yes, no}, yes), "True in 3 of 6 settings; at the stated setting it is true.");
  EXPECT_EQ(sentence({no, no, no, no, no, no}, yes), "True in 0 of 6 settings; at the stated setting it is true.");
  EXPECT_EQ(sentence({yes, open, yes, open, yes, yes}, open),
            "True in 4 of 6 settings, undecided in 2; at the stated setting it is undecided.");
}

TEST(Region, MapsHaveTheLastAxisToTheRight) {
  const std::string table = region_table(grid({yes, no, no, open, no, yes}));
  EXPECT_THAT(table, HasSubstr("| distance | lean:storage=fp32 | lean:storage=fp16 |"));
  EXPECT_THAT(table, HasSubstr("| 1        | ●                 | ○                 |"));
  EXPECT_THAT(table, HasSubstr("| 2        | ○                 | –                 |"));
  EXPECT_THAT(table, HasSubstr("| 4        | ○                 | ●                 |"));
}

TEST(Region, PagesHaveThemAndEscapeTheirText) {
  const std::string page = region_page(grid({yes, no, no, open, no, yes}));
  EXPECT_THAT(page, HasSubstr("Where the claims of a &lt;figure&gt; are true"));
  EXPECT_THAT(page, HasSubstr("True in 2 of 6 settings"));
}

TEST(Region, DocumentsHaveAnOutcomePerSetting) {
  const nlohmann::json document = nlohmann::json::parse(region_json(grid({yes, no, no, open, no, yes})));
  EXPECT_EQ(document.at("schema"), "footprint-region/1");
  EXPECT_EQ(
      document.at("claims").at(0).at("outcomes"),
      nlohmann::json({"reproduced", "not_reproduced", "not_reproduced", "undecided", "not_reproduced", "reproduced"}));
  EXPECT_EQ(document.at("claims").at(0).at("sentence"),
            "True in 2 of 6 settings, all of them with distance 1 or 4, undecided in 1; at the stated setting it is "
            "false.");
  EXPECT_EQ(document.at("settings").at(5).at("values").at("lean"), "lean:storage=fp16");
}

}  // namespace
}  // namespace footprint
