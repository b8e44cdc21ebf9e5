// Writes the frames of an animation: one record a frame and method, and means over the frames in the tables.
#include "results/report/animation_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "renderer/core/files.hpp"
#include "results/report/csv_field.hpp"
#include "results/report/figures.hpp"
#include "results/report/markdown_table.hpp"
#include "results/report/page_shell.hpp"
#include "results/report/results_document.hpp"
#include "results/report/text_template.hpp"

namespace footprint {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* animation_schema = "footprint-animation/2";

// What flicker is made of, by its names in the documents.
struct FlickerPart {
  const char* name;
  std::optional<PartFlicker> FlickerCauses::*member;
};
constexpr std::array<FlickerPart, 4> flicker_parts{{{"shading", &FlickerCauses::shading},
                                                    {"edges", &FlickerCauses::edges},
                                                    {"filter", &FlickerCauses::filter},
                                                    {"method", &FlickerCauses::method}}};

Json animation_error_json(const AnimationRecord& record) {
  if (!record.normalized_color) return nullptr;
  const ErrorCauses& causes = record.causes;
  return {{"normalized_color", json_number(record.normalized_color)},
          {"noise_floor", json_number(record.noise_floor)},
          {"shading", json_number(causes.shading)},
          {"shading_floor", json_number(causes.shading_floor)},
          {"edges", json_number(causes.edges)},
          {"filter", json_number(causes.filter)},
          {"method", json_number(causes.method)}};
}

Json animation_flicker_json(const AnimationRecord& record) {
  Json flicker = flicker_json(record.flicker);
  if (flicker.is_null()) return flicker;
  for (const FlickerPart& part : flicker_parts) {
    const std::optional<PartFlicker>& value = record.flicker_causes.*part.member;
    flicker[part.name] = value ? Json{{"mean", json_number(value->mean)}, {"p99", json_number(value->p99)}} : Json();
  }
  return flicker;
}

Json animation_record_json(const AnimationRecord& record) {
  return {{"frame", record.frame},
          {"method", record.method},
          {"error", animation_error_json(record)},
          {"flicker", animation_flicker_json(record)},
          {"highlight_energy", json_number(record.highlight_energy)},
          {"image", record.image}};
}

Json animation_frame_json(const AnimationFrame& frame) {
  const PixelCounts& pixels = frame.pixels;
  return {{"frame", frame.frame},
          {"distance", json_number(frame.distance)},
          {"degrees", json_number(frame.degrees)},
          {"pixels",
           {{"object", pixels.object},
            {"unresolved", pixels.unresolved},
            {"interior", pixels.interior},
            {"bound", pixels.bound ? Json(*pixels.bound) : Json()}}},
          {"standard_error", json_number(frame.standard_error)},
          {"highlight_energy", json_number(frame.highlight_energy)},
          {"image", frame.image}};
}

Json animation_document(const Animation& animation) {
  Json frames = Json::array(), records = Json::array();
  for (const AnimationFrame& frame : animation.frames) frames.push_back(animation_frame_json(frame));
  for (const AnimationRecord& record : animation.records) records.push_back(animation_record_json(record));
  const ReferenceInfo& reference = animation.reference;
  return {{"schema", animation_schema},
          {"tool", tool_json(animation.tool)},
          {"backend", backend_json(animation.backend)},
          {"scene", scene_json(animation.scene)},
          {"reference",
           {{"spp", reference.spp},
            {"filter", reference.filter},
            {"seed", reference.seed},
            {"environment", reference.environment.empty() ? Json() : Json(reference.environment)}}},
          {"footprint", animation.footprint},
          {"path", animation.way.path},
          {"axis", animation.way.axis ? Json(*animation.way.axis) : Json()},
          {"size", Json::array({animation.width, animation.height})},
          {"film", animation.film.empty() ? Json() : Json(animation.film)},
          {"frames", std::move(frames)},
          {"records", std::move(records)}};
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
  Summary error, floor, flicker, p99, flicker_floor, highlights;
  for (const AnimationRecord& record : animation.records) {
    if (record.method != method) continue;
    error.add(record.normalized_color);
    floor.add(record.noise_floor);
    highlights.add(record.highlight_energy);
    if (!record.flicker) continue;
    flicker.add(record.flicker->mean);
    p99.add(record.flicker->p99);
    flicker_floor.add(record.flicker->noise_floor);
  }
  return {
      method,          error.mean_text(),         floor.mean_text(),     flicker.mean_text(), flicker.largest_text(),
      p99.mean_text(), flicker_floor.mean_text(), highlights.mean_text()};
}

std::vector<std::string> cause_row(const Animation& animation, const std::string& method) {
  std::vector<std::string> row{method};
  for (const FlickerPart& part : flicker_parts) {
    Summary mean, p99;
    for (const AnimationRecord& record : animation.records) {
      const std::optional<PartFlicker>& value = record.flicker_causes.*part.member;
      if (record.method != method || !value) continue;
      mean.add(value->mean);
      p99.add(value->p99);
    }
    row.push_back(mean.mean_text());
    row.push_back(p99.mean_text());
  }
  return row;
}

std::string path_words(const Animation& animation) {
  const AnimationFrame& last = animation.frames.back();
  if (animation.way.path == "zoom")
    return fmt::format("a zoom from distance {:g} to {:g}", animation.frames.front().distance, last.distance);
  return fmt::format("{} by {:g} degrees at distance {:g}",
                     animation.way.path == "orbit" ? "an orbit" : "the lights turn", last.degrees, last.distance);
}

std::string highlights_of_reference(const Animation& animation) {
  Summary energy;
  for (const AnimationFrame& frame : animation.frames) energy.add(frame.highlight_energy);
  return energy.mean_text();
}

}  // namespace

std::string animation_json(const Animation& animation) { return json_text(animation_document(animation), 2) + "\n"; }

std::string animation_csv(const Animation& animation) {
  std::string csv =
      "frame,distance,degrees,method,normalized_color_error,noise_floor,shading,edges,filter,method_share,flicker,"
      "flicker_p99,flicker_noise_floor";
  for (const FlickerPart& part : flicker_parts) csv += fmt::format(",flicker_{0},flicker_{0}_p99", part.name);
  csv += ",highlight_energy,reference_highlight_energy,image\r\n";
  for (const AnimationRecord& record : animation.records) {
    const AnimationFrame& frame = animation.frames.at(static_cast<std::size_t>(record.frame));
    const auto& flicker = record.flicker;
    csv +=
        fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}", record.frame, frame.distance, frame.degrees,
                    csv_field(record.method), csv_field(record.normalized_color), csv_field(record.noise_floor),
                    csv_field(record.causes.shading), csv_field(record.causes.edges), csv_field(record.causes.filter),
                    csv_field(record.causes.method), flicker ? csv_field(flicker->mean) : "",
                    flicker ? csv_field(flicker->p99) : "", flicker ? csv_field(flicker->noise_floor) : "");
    for (const FlickerPart& part : flicker_parts) {
      const std::optional<PartFlicker>& value = record.flicker_causes.*part.member;
      csv += fmt::format(",{},{}", value ? csv_field(value->mean) : "", value ? csv_field(value->p99) : "");
    }
    csv += fmt::format(",{},{},{}\r\n", csv_field(record.highlight_energy), csv_field(frame.highlight_energy),
                       csv_field(record.image));
  }
  return csv;
}

std::string animation_table(const Animation& animation) {
  std::vector<std::vector<std::string>> rows, causes;
  for (const std::string& method : methods_in_order(animation.records)) {
    rows.push_back(table_row(animation, method));
    causes.push_back(cause_row(animation, method));
  }
  std::string text =
      fmt::format("# {}, {} frames: {}\n\n", markdown_escaped(animation.scene.name), animation.frames.size(),
                  path_words(animation)) +
      markdown_table({{"Method", false},
                      {"Error"},
                      {"Floor"},
                      {"Flicker"},
                      {"Worst frame"},
                      {"99th perc."},
                      {"Flicker floor"},
                      {"Highlights"}},
                     rows) +
      fmt::format(R"(
Error: normalised colour error against the reference, mean over the frames. Flicker: how much the change since the
previous frame differs from the reference's, mean over the object's pixels and the frames, and 99th percentile over the
pixels. Floors: the part that the reference's own noise causes. Highlights: exposed luminance above 0.8, mean over the
pixels; {} in the reference.

Flicker by cause, mean and 99th percentile:

)",
                  highlights_of_reference(animation)) +
      markdown_table(
          {{"Method", false}, {"Shading"}, {"p99"}, {"Edges"}, {"p99"}, {"Filter"}, {"p99"}, {"Method's own"}, {"p99"}},
          causes) +
      R"(
Shading: pixels that are interior in both frames. Edges: the object's other pixels. Filter: flicker of the exact sum
under the same footprint filter. Method's own: flicker of the image compared with that sum.
)";
  for (const std::string& warning : animation.scene.warnings)
    text += fmt::format("\nWarning: {}.\n", markdown_escaped(warning));
  return text;
}

std::string animation_page(const Animation& animation) {
  const std::string title = html_escaped(animation.scene.name), table = html_escaped(animation_table(animation));
  const std::string lede = html_escaped(fmt::format("{} frames: {}.", animation.frames.size(), path_words(animation)));
  const std::string data = script_escaped(json_text(animation_document(animation), -1));
  return fill_page({.file = "animation.html", .title = animation.scene.name + ", frame by frame"},
                   {{"title", title},
                    {"lede", lede},
                    {"chart", page_text("chart.min.js")},
                    {"script", page_text("animation.js")},
                    {"table", table},
                    {"data", data}});
}

void write_animation(const Animation& animation, const std::filesystem::path& folder) {
  write_file_atomically(folder / "animation.json", animation_json(animation));
  write_file_atomically(folder / "animation.csv", animation_csv(animation));
  write_file_atomically(folder / "table.md", animation_table(animation));
  write_file_atomically(folder / "index.html", animation_page(animation));
}

}  // namespace footprint
