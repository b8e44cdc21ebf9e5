// Means over the frames of an animation, each over those that have the figure.
#include "results/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "results/report/figures.hpp"
#include "results/report/markup.hpp"
#include "results/report/ranking.hpp"

namespace footprint {
namespace {

constexpr std::array flicker_parts{&FlickerCauses::shading, &FlickerCauses::edges, &FlickerCauses::filter,
                                   &FlickerCauses::method};

// The mean and the maximum of the figures that exist.
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

std::vector<std::string> mean_row(const Results& results, const std::string& method) {
  Summary error, floor, flicker, p99, flicker_floor, highlights;
  for (const Record& record : results.records) {
    if (record.method != method) continue;
    if (record.error) {
      error.add(record.error->normalized_color);
      floor.add(record.error->noise_floor);
    }
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

std::vector<std::string> cause_row(const Results& results, const std::string& method) {
  std::vector<std::string> row{method};
  for (const auto part : flicker_parts) {
    Summary mean, p99;
    for (const Record& record : results.records) {
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

std::string highlights_of_reference(const Results& results, const std::string& method) {
  Summary energy;
  for (const Record& record : results.records) {
    if (record.method == method) energy.add(record.reference_highlight_energy);
  }
  return energy.mean_text();
}

}  // namespace

std::string path_words(const Results& results) {
  const Record &first = results.records.front(), &last = results.records.back();
  if (results.way->path == "zoom")
    return fmt::format("a zoom from distance {:g} to {:g}", first.distance, last.distance);
  if (results.way->path == "animation")
    return fmt::format("its animation from {:g} to {:g} s at distance {:g}", first.seconds, last.seconds,
                       last.distance);
  return fmt::format("{} by {:g} degrees at distance {:g}",
                     results.way->path == "orbit" ? "an orbit" : "the lights turn", last.degrees, last.distance);
}

std::string animation_table(const Results& results) {
  const std::vector<std::string> methods = methods_in_order(results.records);
  std::vector<std::vector<std::string>> rows, causes;
  for (const std::string& method : methods) {
    rows.push_back(mean_row(results, method));
    causes.push_back(cause_row(results, method));
  }
  std::string text =
      fmt::format("# {}, {} frames: {}\n\n", markdown_escaped(results.scene.name),
                  results.records.size() / methods.size(), path_words(results)) +
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
                  highlights_of_reference(results, methods.front())) +
      markdown_table(
          {{"Method", false}, {"Shading"}, {"p99"}, {"Edges"}, {"p99"}, {"Filter"}, {"p99"}, {"Method's own"}, {"p99"}},
          causes) +
      R"(
Shading: pixels that are interior in both frames. Edges: the object's other pixels. Filter: flicker of the exact sum
under the same footprint filter. Method's own: flicker of the image compared with that sum.
)";
  std::vector<std::string> warnings = ranking_warnings(results);
  warnings.insert(warnings.end(), results.scene.warnings.begin(), results.scene.warnings.end());
  for (const std::string& warning : warnings) text += fmt::format("\nWarning: {}.\n", markdown_escaped(warning));
  return text;
}

}  // namespace footprint
