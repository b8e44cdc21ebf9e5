// results.json: its field names, the round trip, and how documents that are not quite right are refused.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "renderer/core/error.hpp"
#include "results/report/example_results.hpp"
#include "results/report/report.hpp"

namespace footprint {
namespace {

using nlohmann::json;

/// What parse_results says about a document that `change` has been made to.
template <typename Change>
std::string complaint(Change change) {
  json document = json::parse(results_json(example_results()));
  change(document);
  try {
    (void)parse_results(document.dump(), "run/results.json");
  } catch (const Error& fault) {
    EXPECT_EQ(fault.kind(), ErrorKind::usage);
    return fault.what();
  }
  ADD_FAILURE() << "the document was taken";
  return {};
}

TEST(ResultsJson, HasThePublishedFields) {
  const json document = json::parse(results_json(example_results()));
  EXPECT_EQ(document.at("schema"), "footprint-results/1");
  for (const char* place : {"/tool/version",
                            "/backend/renderer",
                            "/scene/exposure",
                            "/reference/spp",
                            "/reference/filter",
                            "/reference/standard_error",
                            "/timing/frames",
                            "/timing/processes",
                            "/supersampling/0/spp",
                            "/supersampling/0/normalized_color",
                            "/supersampling/0/ms",
                            "/records/0/scene",
                            "/records/0/method",
                            "/records/0/options/probes",
                            "/records/0/distance",
                            "/records/0/frame",
                            "/records/0/error/normalized_color",
                            "/records/0/error/relative_rmse",
                            "/records/0/error/relmse",
                            "/records/0/error/psnr",
                            "/records/0/error/energy_bias",
                            "/records/0/error/noise_floor",
                            "/records/0/error/representation",
                            "/records/0/error/filtering",
                            "/records/0/equivalent_spp",
                            "/records/0/other_references/0/spp",
                            "/records/4/flicker/p99",
                            "/experiment/claims/0/as_expected",
                            "/experiment/published/1/measured",
                            "/experiment/thresholds/2/held",
                            "/records/0/time/frame_ms/median",
                            "/records/0/time/frame_ms/min",
                            "/records/0/time/frame_ms/p90",
                            "/records/0/time/frame_build_ms",
                            "/records/0/time/frame_build",
                            "/records/0/time/fps",
                            "/records/0/time/ratio_to_direct/median",
                            "/records/0/time/ratio_to_direct/min",
                            "/records/0/time/ratio_to_direct/max",
                            "/records/0/precompute/seconds",
                            "/records/0/precompute/bytes",
                            "/records/0/precompute/cached",
                            "/records/0/effects/on",
                            "/records/0/effects/left_out",
                            "/records/0/images/color",
                            "/records/0/images/reference",
                            "/records/0/images/error"}) {
    EXPECT_TRUE(document.contains(json::json_pointer(place))) << place;
  }
  EXPECT_EQ(document["records"][0]["size"], json::array({256, 256}));
  EXPECT_EQ(document["records"][3]["time"]["frame_build_ms"], 0.31);
  EXPECT_EQ(document["records"][3]["time"]["frame_build"], "every frame");
  EXPECT_EQ(document["records"][0]["time"]["frame_build_ms"], nullptr);
}

TEST(ResultsJson, RoundTripKeepsEveryByte) {
  for (const Results& results : {example_results(), hostile_results()}) {
    const std::string written = results_json(results);
    EXPECT_EQ(results_json(parse_results(written, "results.json")), written);
  }
}

TEST(ResultsJson, RoundTripKeepsTheValues) {
  const Results expected = hostile_results();
  const Results found = parse_results(results_json(expected), "results.json");
  ASSERT_EQ(found.records.size(), expected.records.size());
  EXPECT_EQ(found.scene.name, expected.scene.name);
  EXPECT_EQ(found.scene.warnings.at(0), "not UTF-8: \xEF\xBF\xBD\xEF\xBF\xBD, and <!-- a comment");
  EXPECT_EQ(found.reference.seed, expected.reference.seed);
  EXPECT_EQ(found.records[1].method, expected.records[1].method);
  EXPECT_EQ(found.records[1].options, expected.records[1].options);
  EXPECT_FALSE(found.records[2].error.has_value());
  EXPECT_EQ(found.records[2].equivalent_bound, "n/a");
  EXPECT_TRUE(std::isinf(found.records[3].error->psnr));
  EXPECT_TRUE(std::isinf(found.records[3].error->relmse));
  EXPECT_TRUE(std::isinf(found.records[3].error->energy_bias));
  EXPECT_TRUE(std::isnan(found.records[3].ratio_to_direct.median));
  EXPECT_FALSE(found.records[3].error->noise_floor.has_value());
  EXPECT_FALSE(found.supersampling[3].normalized_color.has_value());
  EXPECT_EQ(found.records[0].error->normalized_color, expected.records[0].error->normalized_color);
  EXPECT_EQ(found.records[0].frame_ms.p90, expected.records[0].frame_ms.p90);
  EXPECT_EQ(found.records[1].precompute_bytes, expected.records[1].precompute_bytes);
  EXPECT_EQ(found.records[0].other_references.at(1).normalized_color, 0.0217);
  EXPECT_EQ(found.records[4].flicker->p99, 0.4);
  EXPECT_FALSE(found.records[5].flicker->noise_floor.has_value());
  EXPECT_EQ(found.experiment->shortfalls().size(), 3U);
  EXPECT_TRUE(found.experiment->quick);
}

TEST(ResultsJson, AnEmptyRunIsWritten) {
  Results nothing;
  nothing.reference.spp = 1;
  nothing.timing = {.frames = 1, .processes = 1};
  EXPECT_TRUE(parse_results(results_json(nothing), "results.json").records.empty());
}

TEST(ResultsJson, ErrorsNameFilePlaceAndNearestKey) {
  const std::string unknown = complaint([](json& d) { d["records"][1]["time"]["fsp"] = 1; });
  EXPECT_NE(unknown.find("run/results.json, /records/1/time: unknown key `fsp`"), std::string::npos) << unknown;
  EXPECT_NE(unknown.find("fps"), std::string::npos) << unknown;
  EXPECT_EQ(complaint([](json& d) { d["records"][0].erase("images"); }),
            "run/results.json, /records/0: the key `images` is missing");
  EXPECT_EQ(complaint([](json& d) { d["supersampling"][2]["ms"] = "fast"; }),
            "run/results.json, /supersampling/2/ms: must be a number");
  EXPECT_EQ(complaint([](json& d) { d["records"][0]["options"]["probes"] = true; }),
            "run/results.json, /records/0/options/probes: must be a number");
  EXPECT_EQ(complaint([](json& d) { d["experiment"]["claims"][1]["as_expected"] = true; }),
            "run/results.json, /experiment/claims/1/as_expected: contradicts expect and outcome");
  EXPECT_EQ(complaint([](json& d) { d["experiment"]["thresholds"][0]["held"] = false; }),
            "run/results.json, /experiment/thresholds/0/held: contradicts limit and measured");
  EXPECT_EQ(complaint([](json& d) { d["schema"] = "footprint-results/2"; }),
            "run/results.json, /schema: unknown schema `footprint-results/2` (this version reads "
            "`footprint-results/1`)");
}

TEST(ResultsJson, RefusesWrongTypesAndRanges) {
  EXPECT_NE(complaint([](json& d) { d["records"][0]["frame"] = -1; }), "");
  EXPECT_NE(complaint([](json& d) { d["records"][0]["frame"] = 1.5; }), "");
  EXPECT_NE(complaint([](json& d) { d["records"][0]["frame"] = 1e12; }), "");
  EXPECT_NE(complaint([](json& d) { d["records"][0]["size"] = {512}; }), "");
  EXPECT_NE(complaint([](json& d) { d["records"][0]["size"] = {0, 512}; }), "");
  EXPECT_NE(complaint([](json& d) { d["records"][0]["time"]["frame_ms"]["median"] = nullptr; }), "");
  EXPECT_NE(complaint([](json& d) { d["records"] = json::object(); }), "");
  EXPECT_NE(complaint([](json& d) { d["scene"]["warnings"] = {1}; }), "");
  EXPECT_NE(complaint([](json& d) { d["records"][0]["precompute"]["cached"] = 1; }), "");
  EXPECT_NE(complaint([](json& d) { d["reference"]["spp"] = 0; }), "");
  EXPECT_NE(complaint([](json& d) { d = json::array(); }), "");
}

TEST(ResultsJson, TextThatIsNoJsonIsOneError) {
  for (const char* text : {"", "{", R"({"schema": "footprint-results/1")", "[1,]", "\xff"}) {
    try {
      (void)parse_results(text, "results.json");
      ADD_FAILURE() << "`" << text << "` was taken";
    } catch (const Error& fault) {
      EXPECT_EQ(std::string(fault.what()).rfind("results.json: parse error at line 1", 0), 0U) << fault.what();
    }
  }
}

}  // namespace
}  // namespace footprint
