// The results of runs as data of the page: their documents, and figures and findings as text.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "results/report/columns.hpp"
#include "results/report/experiment_report.hpp"
#include "results/report/figures.hpp"
#include "results/report/gpu_cost_report.hpp"
#include "results/report/page.hpp"
#include "results/report/ranking.hpp"
#include "results/report/record_fields.hpp"
#include "results/report/report.hpp"

namespace footprint {
namespace {

using Json = nlohmann::ordered_json;

/// Whether the record's frames are shorter than all others of its distance, for any spread.
bool is_fastest(const Record& record, const DistanceRecords& records) {
  return records.size() > 1 && std::ranges::all_of(records, [&](const Record& other) {
           return &other == &record || record.frame_ms.p90 < other.frame_ms.minimum;
         });
}

/// Whether the record alone is first in its distance's ranking.
bool is_best(const Record& record, const DistanceRecords& records) {
  const auto is_first = [&](const Record& r) { return rank(r, records) == 1; };
  return records.size() > 1 && is_first(record) && std::ranges::count_if(records, is_first) == 1;
}

/// The columns of the page's table, in order.
std::vector<std::string_view> page_columns() {
  std::vector<std::string_view> keys{"distance"};
  keys.insert(keys.end(), error_columns.begin(), error_columns.end());
  keys.emplace_back("flicker");
  keys.insert(keys.end(), time_columns.begin(), time_columns.end());
  for (const char* key :
       {"frame_build_ms", "precompute_s", "precompute_bytes", "precompute_bytes_per_texel", "effects_left_out"})
    keys.emplace_back(key);
  return keys;
}

Json columns_json() {
  Json columns = Json::array();
  for (const std::string_view key : page_columns()) {
    const Column& column = column_of(key);
    columns.push_back({{"key", column.key},
                       {"place", column.place},
                       {"title", column.title},
                       {"meaning", column.meaning},
                       {"words", column.is_words}});
  }
  return columns;
}

/// A record's figures as the page prints them, the same as in the table.
/// json: the record as results.json has it.
Json display(const Results& results, const Record& record, const Json& json) {
  const DistanceRecords records = records_at(results, record.distance);
  const std::optional<int> place = rank(record, records);
  Json cells{{"rank", place ? fmt::format("{}", *place) : "–"},
             {"change", change_from_direct(results, record)},
             {"at_floor", shading_at_noise_floor(record)},
             {"is_best", is_best(record, records)},
             {"is_fastest", is_fastest(record, records)}};
  for (const std::string_view key : page_columns()) {
    const Column& column = column_of(key);
    if (column.format != nullptr) cells[std::string(key)] = cell_text(column, record, json);
  }
  return cells;
}

/// The answer and the findings at a distance, and the scale of its error images.
Json distance_json(const Results& results, double distance) {
  const auto scale = std::ranges::find(results.error_scales, distance, &ErrorScale::distance);
  const double top = scale == results.error_scales.end() ? results.error_scale : scale->error;
  const DistanceAnswer answer = answer_at(results, distance);
  return {{"distance", distance},
          {"answer", answer.sentences},
          {"shown", answer.methods},
          {"pixels", pixels_and_noise(records_at(results, distance).front())},
          {"findings", findings(results, distance)},
          {"scale_top", error_text(top)}};
}

// The content of the page for a run; `folder` is that of its images, below the page's own.
Json run_json(const Results& results, const std::string& folder) {
  Json head = Json::array();
  for (const Provenance& line : provenance(results)) head.push_back({{"label", line.label}, {"value", line.value}});
  Json document = results_document(results);
  Json records = Json::array(), distances = Json::array();
  if (!results.way) {
    for (std::size_t i = 0; i < results.records.size(); ++i) {
      const Record& record = results.records[i];
      records.push_back(display(results, record, document.at("records").at(i)));
    }
    for (const double distance : distances_of(results)) distances.push_back(distance_json(results, distance));
  }
  return {{"folder", folder},
          {"path", results.way ? path_words(results) : ""},
          {"coordinates", to_json_value(results.coordinates)},
          {"results", std::move(document)},
          {"provenance", std::move(head)},
          {"display", std::move(records)},
          {"distances", std::move(distances)},
          {"scale_top", error_text(results.error_scale)}};
}

// The page of runs: its scripts make views of their records.
std::string page_of(Page page, Json runs) {
  page.eyebrow = "error, cost and memory of normal map filtering";
  return page_html(page, Json{{"runs", std::move(runs)}, {"columns", columns_json()}});
}

}  // namespace

std::string results_page(const Results& results) {
  Json runs = Json::array();
  runs.push_back(run_json(results, ""));
  return page_of({.title = results.scene.name,
                  .text = results_table(results),
                  .exposure = results.scene.exposure,
                  .experiment = results.experiment ? experiment_html(*results.experiment) : "",
                  .gpus = gpu_costs_html(results)},
                 std::move(runs));
}

std::string matrix_page(const MatrixResults& matrix) {
  Json runs = Json::array();
  for (const auto& [folder, results] : matrix.members) runs.push_back(run_json(results, folder));
  return page_of(
      {.title = matrix.report.title, .text = matrix_table(matrix), .experiment = experiment_html(matrix.report)},
      std::move(runs));
}

}  // namespace footprint
