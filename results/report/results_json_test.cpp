// results.json: every kind of value at its place; footprint_schemas and schema_test.py check the whole document. Files
// that it lists are found in documents of this program, and in no other file.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "results/report/report.hpp"
#include "tests/report/example_results.hpp"
#include "tests/support/fresh_folder.hpp"

namespace footprint {
namespace {

using nlohmann::json;

TEST(ResultsJson, EachKindOfValueIsWritten) {
  const json document = json::parse(results_json(example_results()));
  EXPECT_EQ(document.at("schema"), "footprint-results/2");
  EXPECT_EQ(document["records"][0]["size"], json::array({256, 256}));
  EXPECT_EQ(document["records"][3]["time"]["frame_build_ms"], 0.31);
  EXPECT_EQ(document["records"][3]["time"]["frame_build"], "every frame");
  EXPECT_EQ(document["records"][0]["time"]["frame_build_ms"], nullptr);
}

TEST(ResultsJson, NumbersAreWrittenToTheLastBit) {
  const Results results = example_results();
  const json document = json::parse(results_json(results));
  ASSERT_EQ(document["records"].size(), results.records.size());
  for (std::size_t i = 0; i < results.records.size(); ++i) {
    const Record& record = results.records[i];
    const json& written = document["records"][i];
    EXPECT_EQ(written["method"], record.method);
    EXPECT_EQ(written["error"]["normalized_color"], record.error->normalized_color);
    EXPECT_EQ(written["error"]["filtering"], record.error->filtering);
    EXPECT_EQ(written["time"]["frame_ms"]["p90"], record.frame_ms.p90);
    EXPECT_EQ(written["precompute"]["bytes"], record.precompute_bytes);
  }
  EXPECT_EQ(document["records"][0]["other_references"][1]["normalized_color"], 0.0217);
  EXPECT_EQ(document["records"][4]["flicker"]["p99"], 0.4);
  EXPECT_EQ(document["experiment"]["quick"], true);
  EXPECT_EQ(document["records"][1]["error"]["light"], 0.0021);
  EXPECT_EQ(document["records"][0]["error"]["method"], *results.records[0].error->causes.method);
  EXPECT_EQ(document["records"][0]["pixels"], (json{{"object", 12345},
                                                    {"unresolved", 50},
                                                    {"interior", 9260},
                                                    {"minified", 9000},
                                                    {"bound", 9260},
                                                    {"light", nullptr}}));
  EXPECT_EQ(document["records"][4]["pixels"]["bound"], nullptr);
  EXPECT_EQ(document["records"][1]["time"]["fetches"], 96.5);
  EXPECT_EQ(document["error_scales"][1], (json{{"distance", 4.0}, {"error", 0.025}}));
}

TEST(ResultsJson, WhatIsAbsentOrNotFiniteIsNull) {
  const Results results = hostile_results();
  const json document = json::parse(results_json(results));
  for (const char* place :
       {"/reference/standard_errors/0", "/records/2/error", "/records/2/equivalent_spp", "/records/3/error/psnr",
        "/records/3/error/relmse", "/records/3/error/energy_bias", "/records/3/error/noise_floor",
        "/records/3/time/ratio_to_direct/median", "/records/5/flicker/noise_floor", "/records/0/flicker",
        "/supersampling/3/normalized_color", "/experiment/thresholds/2/measured"}) {
    EXPECT_TRUE(document.at(json::json_pointer(place)).is_null()) << place;
  }
  EXPECT_EQ(document["reference"]["seed"], results.reference.seed);
}

TEST(ResultsJson, NamesOfAnyBytesSurvive) {
  const Results results = hostile_results();
  const json document = json::parse(results_json(results));
  EXPECT_EQ(document["scene"]["name"], results.scene.name);
  EXPECT_EQ(document["scene"]["warnings"][0], "not UTF-8: \xEF\xBF\xBD\xEF\xBF\xBD, and <!-- a comment");
  EXPECT_EQ(document["records"][1]["method"], results.records[1].method);
  EXPECT_EQ(document["records"][1]["options"]["a/b~c"], "=;\"");
}

TEST(ResultsJson, TheBoundOfASampleCountIsNextToIt) {
  Results results = example_results();
  results.records[0].equivalent = EquivalentSamples{1, CurveSide::below};
  results.records[1].equivalent = EquivalentSamples{64, CurveSide::above};
  results.records[2].equivalent = EquivalentSamples{41.5, CurveSide::within};
  results.records[3].equivalent.reset();
  const json records = json::parse(results_json(results))["records"];
  EXPECT_EQ(records[0]["equivalent_bound"], "<1");
  EXPECT_EQ(records[1]["equivalent_bound"], ">64");
  EXPECT_EQ(records[2]["equivalent_bound"], "");
  EXPECT_EQ(records[3]["equivalent_bound"], "n/a");
  EXPECT_EQ(records[2]["equivalent_spp"], 41.5);
  for (const std::size_t beside : {0, 1, 3}) EXPECT_TRUE(records[beside]["equivalent_spp"].is_null()) << beside;
}

TEST(ResultsJson, ClaimsSayHowTheyCameOut) {
  const json claims = json::parse(results_json(example_results()))["experiment"]["claims"];
  EXPECT_EQ(claims[0]["source"], "gpu_time");
  EXPECT_EQ(claims[1]["source"], "ours");  // the default
  EXPECT_EQ(claims[0]["expect"], "reproduced");
  EXPECT_EQ(claims[0]["outcome"], "reproduced");
  EXPECT_EQ(claims[0]["as_expected"], true);
  EXPECT_EQ(claims[1]["expect"], "not_reproduced");
  EXPECT_EQ(claims[1]["outcome"], "undecided");
  EXPECT_EQ(claims[1]["as_expected"], false);
}

TEST(ResultsJson, AnEmptyRunIsWritten) { EXPECT_TRUE(json::parse(results_json(Results{}))["records"].empty()); }

namespace fs = std::filesystem;

TEST(ListedFiles, AreThePicturesOfTheDocument) {
  const fs::path folder = test::fresh_folder();
  const Results results = example_results();
  write_report(results, folder);
  const std::vector<fs::path> files = listed_files(folder / "results.json");
  for (const std::string& color : {results.records.at(0).images.color, results.records.at(0).images.reference}) {
    EXPECT_NE(std::ranges::find(files, fs::path(color)), files.end()) << color;
    EXPECT_NE(std::ranges::find(files, fs::path(color).replace_extension(".png")), files.end()) << color;
  }
  for (const fs::path& file : files) EXPECT_EQ(*file.begin(), "images") << file;
}

TEST(ListedFiles, AreNoneOfWhatIsNotOurs) {
  const fs::path folder = test::fresh_folder();
  const auto found = [&](const char* text) {
    std::ofstream(folder / "results.json") << text;
    return listed_files(folder / "results.json").size();
  };
  EXPECT_EQ(found(R"({"schema": "footprint-results/2", "x": "images/a.png"})"), 1U);
  EXPECT_EQ(found(R"({"schema": "another", "x": "images/a.png"})"), 0U);
  EXPECT_EQ(found(R"({"x": "images/a.png"})"), 0U);
  EXPECT_EQ(found(R"(["images/a.png"])"), 0U);
  EXPECT_EQ(found(R"({"schema": 7)"), 0U);
  EXPECT_EQ(found(""), 0U);
  EXPECT_TRUE(listed_files(folder / "absent.json").empty());
}

}  // namespace
}  // namespace footprint
