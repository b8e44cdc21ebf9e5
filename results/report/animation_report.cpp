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
#include "results/report/record_fields.hpp"
#include "results/report/results_document.hpp"
#include "results/report/text_template.hpp"

namespace footprint {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* animation_schema = "footprint-animation/2";

constexpr std::array flicker_parts{&FlickerCauses::shading, &FlickerCauses::edges, &FlickerCauses::filter,
                                   &FlickerCauses::method};

// The columns of animation.csv, with their places in {"frame": ..., "record": ...}.
constexpr std::array csv_columns{CsvColumn{"frame", "/record/frame"},
                                 CsvColumn{"distance", "/frame/distance"},
                                 CsvColumn{"degrees", "/frame/degrees"},
                                 CsvColumn{"method", "/record/method"},
                                 CsvColumn{"normalized_color_error", "/record/error/normalized_color"},
                                 CsvColumn{"noise_floor", "/record/error/noise_floor"},
                                 CsvColumn{"shading", "/record/error/shading"},
                                 CsvColumn{"edges", "/record/error/edges"},
                                 CsvColumn{"filter", "/record/error/filter"},
                                 CsvColumn{"method_share", "/record/error/method"},
                                 CsvColumn{"flicker", "/record/flicker/mean"},
                                 CsvColumn{"flicker_p99", "/record/flicker/p99"},
                                 CsvColumn{"flicker_noise_floor", "/record/flicker/noise_floor"},
                                 CsvColumn{"flicker_shading", "/record/flicker/shading/mean"},
                                 CsvColumn{"flicker_shading_p99", "/record/flicker/shading/p99"},
                                 CsvColumn{"flicker_edges", "/record/flicker/edges/mean"},
                                 CsvColumn{"flicker_edges_p99", "/record/flicker/edges/p99"},
                                 CsvColumn{"flicker_filter", "/record/flicker/filter/mean"},
                                 CsvColumn{"flicker_filter_p99", "/record/flicker/filter/p99"},
                                 CsvColumn{"flicker_method", "/record/flicker/method/mean"},
                                 CsvColumn{"flicker_method_p99", "/record/flicker/method/p99"},
                                 CsvColumn{"highlight_energy", "/record/highlight_energy"},
                                 CsvColumn{"reference_highlight_energy", "/frame/highlight_energy"},
                                 CsvColumn{"image", "/record/image"}};

Json animation_document(const Animation& animation) {
  const ReferenceInfo& reference = animation.reference;
  return {{"schema", animation_schema},
          {"tool", to_json_value(animation.tool)},
          {"backend", to_json_value(animation.backend)},
          {"scene", to_json_value(animation.scene)},
          {"reference",
           {{"spp", reference.spp},
            {"filter", reference.filter},
            {"seed", reference.seed},
            {"environment", to_json_value(reference.environment)}}},
          {"footprint", animation.footprint},
          {"path", animation.way.path},
          {"axis", animation.way.axis ? Json(*animation.way.axis) : Json()},
          {"size", Json::array({animation.width, animation.height})},
          {"film", animation.film.empty() ? Json() : Json(animation.film)},
          {"frames", to_json_value(animation.frames)},
          {"records", to_json_value(animation.records)}};
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
    if (record.error) {
      error.add(record.error->normalized_color);
      floor.add(record.error->noise_floor);
    }
    highlights.add(record.highlight_energy);
    if (!record.flicker) continue;
    flicker.add(record.flicker->whole.mean);
    p99.add(record.flicker->whole.p99);
    flicker_floor.add(record.flicker->whole.noise_floor);
  }
  return {
      method,          error.mean_text(),         floor.mean_text(),     flicker.mean_text(), flicker.largest_text(),
      p99.mean_text(), flicker_floor.mean_text(), highlights.mean_text()};
}

std::vector<std::string> cause_row(const Animation& animation, const std::string& method) {
  std::vector<std::string> row{method};
  for (const auto part : flicker_parts) {
    Summary mean, p99;
    for (const AnimationRecord& record : animation.records) {
      if (record.method != method || !record.flicker) continue;
      const std::optional<PartFlicker>& value = record.flicker->causes.*part;
      if (!value) continue;
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
  std::string csv = csv_header(csv_columns).append(csv_line_end);
  for (const AnimationRecord& record : animation.records) {
    const AnimationFrame& frame = animation.frames.at(static_cast<std::size_t>(record.frame));
    const Json both{{"frame", to_json_value(frame)}, {"record", to_json_value(record)}};
    csv.append(csv_line(csv_columns, both)).append(csv_line_end);
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
