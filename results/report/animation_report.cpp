// Writes the frames of an animation: one record a frame and method, and means over the frames in the table.
#include "results/report/animation_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "renderer/core/files.hpp"
#include "results/report/csv_field.hpp"
#include "results/report/figures.hpp"
#include "results/report/markdown_table.hpp"
#include "results/report/results_document.hpp"

namespace footprint {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* animation_schema = "footprint-animation/1";

Json record_json(const AnimationRecord& record) {
  return {{"frame", record.frame},
          {"distance", json_number(record.distance)},
          {"method", record.method},
          {"normalized_color", json_number(record.normalized_color)},
          {"noise_floor", json_number(record.noise_floor)},
          {"flicker", flicker_json(record.flicker)},
          {"image", record.image}};
}

// Of the figures that are there: their mean and their largest.
struct Summary {
  double sum = 0, largest = 0;
  int count = 0;

  void add(const std::optional<double>& value) {
    if (!value) return;
    sum += *value;
    largest = count == 0 ? *value : std::max(largest, *value);
    ++count;
  }
  [[nodiscard]] std::string mean_text() const { return count > 0 ? error_text(sum / count) : "n/a"; }
  [[nodiscard]] std::string largest_text() const { return count > 0 ? error_text(largest) : "n/a"; }
};

std::vector<std::string> table_row(const Animation& animation, const std::string& method) {
  Summary error, floor, flicker, p99, flicker_floor;
  for (const AnimationRecord& record : animation.records) {
    if (record.method != method) continue;
    error.add(record.normalized_color);
    floor.add(record.noise_floor);
    if (!record.flicker) continue;
    flicker.add(record.flicker->mean);
    p99.add(record.flicker->p99);
    flicker_floor.add(record.flicker->noise_floor);
  }
  return {method,          error.mean_text(),        floor.mean_text(), flicker.mean_text(), flicker.largest_text(),
          p99.mean_text(), flicker_floor.mean_text()};
}

}  // namespace

std::string animation_json(const Animation& animation) {
  Json records = Json::array();
  for (const AnimationRecord& record : animation.records) records.push_back(record_json(record));
  const Json document{{"schema", animation_schema},
                      {"tool", tool_json(animation.tool)},
                      {"backend", backend_json(animation.backend)},
                      {"scene", scene_json(animation.scene)},
                      {"reference", reference_json(animation.reference)},
                      {"size", Json::array({animation.width, animation.height})},
                      {"reference_images", animation.reference_images},
                      {"records", std::move(records)}};
  return json_text(document, 2) + "\n";
}

std::string animation_csv(const Animation& animation) {
  std::string csv =
      "frame,distance,method,normalized_color_error,noise_floor,flicker,flicker_p99,flicker_noise_floor,image\r\n";
  for (const AnimationRecord& record : animation.records) {
    const auto& flicker = record.flicker;
    csv += fmt::format("{},{},{},{},{},{},{},{},{}\r\n", record.frame, record.distance, csv_field(record.method),
                       csv_field(record.normalized_color), csv_field(record.noise_floor),
                       flicker ? csv_field(flicker->mean) : "", flicker ? csv_field(flicker->p99) : "",
                       flicker ? csv_field(flicker->noise_floor) : "", csv_field(record.image));
  }
  return csv;
}

std::string animation_table(const Animation& animation) {
  std::vector<std::string> methods;
  for (const AnimationRecord& record : animation.records) {
    if (std::ranges::find(methods, record.method) == methods.end()) methods.push_back(record.method);
  }
  std::vector<std::vector<std::string>> rows;
  rows.reserve(methods.size());
  for (const std::string& method : methods) rows.push_back(table_row(animation, method));
  return fmt::format("# {}, {} frames\n\n", markdown_escaped(animation.scene.name), animation.reference_images.size()) +
         markdown_table(
             {{"Method", false}, {"Error"}, {"Floor"}, {"Flicker"}, {"Worst frame"}, {"99th perc."}, {"Flicker floor"}},
             rows) +
         R"(
Error: normalised colour error against the reference, mean over the frames. Flicker: by how much the change from the
frame before differs from the reference's, mean over the object's pixels and over the frames; its 99th percentile over
the pixels. Floors: the part of them that the reference's own noise causes.
)";
}

void write_animation(const Animation& animation, const std::filesystem::path& folder) {
  write_file_atomically(folder / "animation.json", animation_json(animation));
  write_file_atomically(folder / "animation.csv", animation_csv(animation));
  write_file_atomically(folder / "table.md", animation_table(animation));
}

}  // namespace footprint
