// The files of a run and of a matrix: results.json, results.csv, table.md, and the page with its data; the files of an
// earlier run.
#include "results/report/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>

#include "renderer/core/files.hpp"
#include "results/report/experiment_report.hpp"
#include "results/report/page.hpp"
#include "results/report/ranking.hpp"
#include "results/report/record_fields.hpp"
#include "results/report/results_table.hpp"

namespace footprint {
namespace {

constexpr const char* pictures = "images/";

void collect(const nlohmann::json& value, std::vector<std::filesystem::path>& files) {
  if (value.is_string() && value.get_ref<const std::string&>().starts_with(pictures)) {
    const std::filesystem::path file = value.get_ref<const std::string&>();
    files.push_back(file);
    if (file.extension() == ".exr") files.push_back(std::filesystem::path(file).replace_extension(".png"));
  }
  if (!value.is_structured()) return;
  for (const nlohmann::json& inner : value) collect(inner, files);
}

// Null where it cannot be read.
nlohmann::json read_document(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return nlohmann::json::parse(stream, nullptr, false);
}

// Empty if the text is missing.
std::string text_in(const nlohmann::json& object, const char* key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

// With paths from the matrix' folder.
Record seen_from_above(Record record, const std::string& folder) {
  RecordImages& images = record.images;
  for (std::string* path : {&images.color, &images.reference, &images.error, &images.error_shared, &images.flip,
                            &images.interior, &images.standard_error}) {
    if (!path->empty()) path->insert(0, folder + "/");
  }
  return record;
}

std::vector<std::string> table_row(const MatrixMember& member, const Record& record) {
  std::vector<std::string> row;
  for (const auto& [axis, value] : member.results.coordinates) row.push_back(value);
  row.insert(row.end(), {record.method, fmt::format("{}", record.distance),
                         record.error ? error_text(record.error->normalized_color) : "n/a",
                         record.error ? error_text(record.error->causes.shading) : "n/a",
                         record.error ? error_text(record.error->noise_floor) : "n/a",
                         three_figures(record.frame_ms.median), three_figures(record.ratio_to_direct.median)});
  return row;
}

std::string records_table(const MatrixResults& matrix) {
  Table table;
  for (const auto& [axis, value] : matrix.members.front().results.coordinates) table.columns.push_back({axis, false});
  table.columns.push_back({"Method", false});
  for (const char* title : {"Distance", "Error", "Shading", "Floor", "Frame ms", "x direct"})
    table.columns.push_back({title});
  for (const MatrixMember& member : matrix.members) {
    for (const Record& record : member.results.records) table.rows.push_back(table_row(member, record));
  }
  return markdown_table(table);
}

// The lines of the members' results.csv, each after its member's name, footprint filter and seed.
std::string matrix_csv(const MatrixResults& matrix) {
  std::string csv = fmt::format("member,footprint,seed,{}{}", csv_header(), csv_line_end);
  for (const auto& [folder, results] : matrix.members) {
    for (const Record& record : results.records)
      csv += fmt::format("{},{},{},{}{}", csv_field(folder), csv_field(results.footprint), results.reference.seed,
                         csv_line(seen_from_above(record, folder)), csv_line_end);
  }
  return csv;
}

using Json = nlohmann::ordered_json;

/// Whether the record's frames are shorter than all others of its distance, for any spread.
bool is_fastest(const Record& record, const DistanceRecords& records) {
  return records.size() > 1 && std::ranges::all_of(records, [&](const Record& other) {
           return &other == &record || record.frame_ms.p90 < other.frame_ms.min;
         });
}

/// Whether the record alone is first in its distance's ranking.
bool is_best(const Record& record, const DistanceRecords& records) {
  const auto is_first = [&](const Record& r) { return rank(r, records) == 1; };
  return records.size() > 1 && is_first(record) && std::ranges::count_if(records, is_first) == 1;
}

std::vector<std::string_view> page_columns() {
  std::vector<std::string_view> keys{"distance"};
  keys.insert(keys.end(), error_columns.begin(), error_columns.end());
  for (const Figure& figure : record_figures()) {
    if (figure.metric && std::ranges::find(keys, figure.key) == keys.end()) keys.emplace_back(figure.key);
  }
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
    const Figure& figure = figure_of(key);
    columns.push_back({{"key", figure.key},
                       {"place", figure.place},
                       {"title", figure.title},
                       {"meaning", figure.meaning},
                       {"words", figure.is_words}});
  }
  return columns;
}

/// A record's figures as the page prints them, the same as in the table.
Json display(const Results& results, const Record& record) {
  const DistanceRecords records = records_at(results, record.distance);
  const std::optional<int> place = rank(record, records);
  Json cells{{"rank", place ? fmt::format("{}", *place) : "–"},
             {"change", change_from_direct(results, record)},
             {"at_floor", shading_at_noise_floor(record)},
             {"is_best", is_best(record, records)},
             {"is_fastest", is_fastest(record, records)}};
  for (const std::string_view key : page_columns()) {
    const Figure& figure = figure_of(key);
    if (figure.format != nullptr) cells[std::string(key)] = cell_text(figure, record);
  }
  return cells;
}

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
  Json document = to_json_value(results);
  Json records = Json::array(), distances = Json::array();
  if (!results.animation) {
    for (const Record& record : results.records) records.push_back(display(results, record));
    for (const double distance : distances_of(results)) distances.push_back(distance_json(results, distance));
  }
  return {{"folder", folder},
          {"path", results.animation ? path_words(results) : ""},
          {"coordinates", to_json_value(results.coordinates)},
          {"results", std::move(document)},
          {"provenance", to_json_value(provenance(results))},
          {"display", std::move(records)},
          {"distances", std::move(distances)},
          {"scale_top", error_text(results.error_scale)}};
}

// The results with a warning about what could not be written so far.
Results with_losses(Results results, const RunFolder& folder) {
  if (std::string text = folder.losses_text(); !text.empty()) results.scene.warnings.push_back(std::move(text));
  return results;
}

// The page of runs: its scripts make views of their records.
std::string make_runs_page(Page page, Json runs) {
  page.eyebrow = "error, cost and memory of normal map filtering";
  return page_html(page, Json{{"runs", std::move(runs)}, {"columns", columns_json()}});
}

}  // namespace

std::string json_text(const nlohmann::ordered_json& document, int indent) {
  return document.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string results_csv(const Results& results) {
  std::string csv = csv_header().append(csv_line_end);
  for (const Record& record : results.records) csv.append(csv_line(record)).append(csv_line_end);
  return csv;
}

std::string results_json(const Results& results) { return json_text(to_json_value(results), 2) + "\n"; }

void write_report(const Results& results, const RunFolder& folder) {
  folder.write_document("results.json", results_json(with_losses(results, folder)));
  folder.write_text("results.csv", [&] { return results_csv(results); });
  folder.write_text("table.md", [&] { return results_table(with_losses(results, folder)); });
  folder.write_text("index.html", [&] { return results_page(with_losses(results, folder)); });
}

std::vector<std::string> files_below(const std::filesystem::path& folder, const std::string& subfolder) {
  std::vector<std::string> files;
  if (!std::filesystem::is_directory(folder / subfolder)) return files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / subfolder)) {
    if (entry.is_regular_file()) files.push_back(entry.path().lexically_relative(folder).generic_string());
  }
  std::ranges::sort(files);
  return files;
}

std::vector<std::filesystem::path> listed_files(const std::filesystem::path& results_json) {
  const nlohmann::json document = read_document(results_json);
  std::vector<std::filesystem::path> files;
  if (text_in(document, "schema").starts_with("footprint-")) collect(document, files);
  return files;
}

std::optional<ListedReference> listed_reference(const std::filesystem::path& reference) {
  const std::filesystem::path folder = std::filesystem::absolute(reference).parent_path().parent_path();
  const nlohmann::json document = read_document(folder / "results.json");
  if (text_in(document, "schema") != results_schema) return {};
  const std::string name = pictures + reference.filename().string();
  const nlohmann::json exposure = document.value(nlohmann::json::json_pointer("/scene/exposure"), nlohmann::json());
  const nlohmann::json records = document.value("records", nlohmann::json::array());
  if (!exposure.is_number() || !records.is_array()) return {};
  for (const nlohmann::json& record : records) {
    const nlohmann::json images = record.is_object() ? record.value("images", nlohmann::json()) : nlohmann::json();
    if (text_in(images, "reference") != name) continue;
    return ListedReference{.exposure = exposure.get<float>(),
                           .standard_error = folder / text_in(images, "standard_error")};
  }
  return {};
}

std::string matrix_table(const MatrixResults& matrix) {
  std::string text = fmt::format("# {}\n", markdown_escaped(matrix.report.title)) + experiment_markdown(matrix.report);
  if (!matrix.left_out.empty())
    text += fmt::format("\nNot judged, because members were left out: {}.\n",
                        markdown_escaped(fmt::format("{}", fmt::join(matrix.left_out, "; "))));
  return text + fmt::format("\n## All records, of {} members\n\n", matrix.members.size()) + records_table(matrix) +
         "\nEach member's own report is in the folder of its name. Floor: the part of the error that the reference's "
         "noise causes.\n";
}

void write_matrix_report(const MatrixResults& matrix, const RunFolder& folder) {
  folder.write_document("matrix.json", json_text(to_json_value(matrix), 2) + "\n");
  folder.write_text("results.csv", [&] { return matrix_csv(matrix); });
  folder.write_text("table.md", [&] { return matrix_table(matrix); });
  folder.write_text("index.html", [&] { return matrix_page(matrix, folder.losses_text()); });
}

std::string results_page(const Results& results) {
  Json runs = Json::array();
  runs.push_back(run_json(results, ""));
  return make_runs_page({.title = results.scene.name,
                         .text = results_table(results),
                         .exposure = results.scene.exposure,
                         .experiment = results.experiment ? experiment_html(*results.experiment) : "",
                         .gpus = gpu_costs_html(results)},
                        std::move(runs));
}

std::string matrix_page(const MatrixResults& matrix, const std::string& lede) {
  Json runs = Json::array();
  for (const auto& [folder, results] : matrix.members) runs.push_back(run_json(results, folder));
  return make_runs_page({.title = matrix.report.title,
                         .lede = lede,
                         .text = matrix_table(matrix),
                         .experiment = experiment_html(matrix.report)},
                        std::move(runs));
}

}  // namespace footprint
