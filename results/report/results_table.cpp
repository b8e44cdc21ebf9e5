// Results as Markdown tables of at most about 130 columns: errors and times by distance, what each method prepares,
// the supersampling curve, and a sentence on each method.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <sstream>
#include <string_view>

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

using Rows = std::vector<std::vector<std::string>>;

/// "2", or "-" where the record is not ranked; `ties` pads for the mark of those that share a place.
std::string rank_text(const Record& record, const DistanceRecords& records) {
  const std::optional<int> place = rank(record, records);
  if (!place) return "-";
  const auto same = [&](const Record& other) { return rank(other, records) == place; };
  return fmt::format("{}{}", *place, std::ranges::count_if(records, same) > 1 ? "=" : " ");
}

/// The shading error with its mark; unmarked ones have blanks instead, so that the figures are aligned.
std::string marked_shading(const Record& record, bool any_marked) {
  if (!record.error) return "n/a";
  const std::string_view mark = shading_at_noise_floor(record) ? " *" : any_marked ? "  " : "";
  return error_text(record.error->causes.shading).append(mark);
}

bool has_light(const DistanceRecords& records) {
  return std::ranges::any_of(records, [](const Record& r) { return r.error && r.error->causes.light; });
}

struct Table {
  std::vector<MarkdownColumn> columns;
  Rows rows;
};

/// "Method", then the columns of the keys; the light's only if there is one. Ranks and shading errors have marks.
Table table_of(std::vector<std::string_view> keys, const DistanceRecords& records) {
  if (!has_light(records)) std::erase(keys, "light_error");
  const bool any_marked = std::ranges::any_of(records, shading_at_noise_floor);
  Table table{.columns = {{"Method", false}}, .rows = {}};
  for (const std::string_view key : keys) table.columns.push_back({plain(column_of(key).title)});
  for (const Record& record : records) {
    const nlohmann::ordered_json json = to_json_value(record);
    std::vector<std::string>& row = table.rows.emplace_back(1, record.method);
    for (const std::string_view key : keys) {
      row.push_back(key == "rank"            ? rank_text(record, records)
                    : key == "shading_error" ? marked_shading(record, any_marked)
                                             : plain(cell_text(column_of(key), record, json)));
    }
  }
  return table;
}

constexpr std::size_t terminal = 130;  // columns

/// One table, or as many as it takes that none is wider than a terminal; each begins with the first column.
std::string split_table(const Table& table) {
  const auto& [columns, rows] = table;
  const auto part = [&](std::size_t first, std::size_t count) {
    const auto cut = [&](const auto& all) {
      auto some = std::vector(all.begin(), all.begin() + 1);
      some.insert(some.end(), all.begin() + static_cast<std::ptrdiff_t>(first),
                  all.begin() + static_cast<std::ptrdiff_t>(first + count));
      return some;
    };
    Rows cut_rows;
    for (const auto& row : rows) cut_rows.push_back(cut(row));
    return markdown_table(cut(columns), cut_rows);
  };
  std::string text;
  for (std::size_t first = 1, count = columns.size() - 1; first < columns.size(); count = columns.size() - first) {
    while (count > 1 && part(first, count).find('\n') > terminal) --count;
    text += (text.empty() ? "" : "\n") + part(first, count);
    first += count;
  }
  return text;
}

/// Errors and times of a distance: in one table if it fits, else each in its own.
std::string main_table(const DistanceRecords& records) {
  const std::vector errors(error_columns.begin(), error_columns.end()), times(time_columns.begin(), time_columns.end());
  std::vector<std::string_view> all = errors;
  all.insert(all.end(), times.begin(), times.end());
  const Table whole = table_of(all, records);
  std::string text = markdown_table(whole.columns, whole.rows);
  if (text.find('\n') <= terminal) return text;
  return split_table(table_of(errors, records)) + "\n" + split_table(table_of(times, records));
}

/// Every two methods of a distance pixel by pixel: empty where none were.
std::string pairs_table(const Results& results, const DistanceRecords& records) {
  std::vector<MarkdownColumn> columns{{"% of pixels closer than", false}};
  Rows rows;
  bool any = false;
  for (const Record& record : records) {
    columns.push_back({markdown_escaped(record.method)});
    std::vector<std::string> row{record.method};
    for (const Record& other : records) {
      const auto share = closer_share(results, record.distance, record.method, other.method);
      any = any || share;
      row.push_back(share ? fmt::format("{:.1f}", 100.0 * *share) : "-");
    }
    rows.push_back(std::move(row));
  }
  return any ? "\n" + split_table({columns, rows}) : std::string();
}

/// An entry of a list, escaped, in lines of a terminal's width.
std::string list_entry(const std::string& text) {
  constexpr std::size_t width = 120;
  std::string entry, line = "-";
  std::istringstream words(markdown_escaped(text));
  for (std::string word; words >> word;) {
    if (line.size() + 1 + word.size() > width) {
      entry += line + "\n";
      line = " ";
    }
    line += " " + word;
  }
  return entry + line + "\n";
}

std::string distance_section(const Results& results, double distance) {
  const DistanceRecords records = records_at(results, distance);
  const bool any_marked = std::ranges::any_of(records, shading_at_noise_floor);
  return fmt::format("\n## Distance {}\n\n{}\n\n{}{}{}", distance, pixels_and_noise(records.front()),
                     main_table(records), pairs_table(results, records),
                     any_marked ? "\n\\* at the noise floor: the reference's own noise explains this error.\n" : "");
}

/// The figures that do not depend on the distance: one line per method, more only if its figures differ.
std::string preparation_section(const Results& results) {
  constexpr std::array<std::string_view, 3> keys{"precompute_s", "precompute_bytes", "precompute_bytes_per_texel"};
  std::vector<MarkdownColumn> columns{{"Method", false}};
  for (const std::string_view key : keys) columns.push_back({plain(column_of(key).title)});
  columns.insert(columns.end(), {{"Cached", false}, {"Effects left out", false}});
  Rows rows;
  for (const Record& record : results.records) {
    const nlohmann::ordered_json json = to_json_value(record);
    std::vector<std::string> row{record.method};
    for (const std::string_view key : keys) row.push_back(plain(cell_text(column_of(key), record, json)));
    row.insert(row.end(), {record.precompute_cached ? "yes" : "no", list_text(record.effects_left_out, "none")});
    if (std::ranges::find(rows, row) == rows.end()) rows.push_back(std::move(row));
  }
  return "\n## Bakes\n\n" + markdown_table(columns, rows);
}

/// Flicker between the frames of a zoom.
std::string flicker_section(const Results& results) {
  Rows rows;
  for (const Record& record : results.records) {
    if (!record.flicker) continue;
    const Flicker& flicker = *record.flicker;
    rows.push_back({fmt::format("{}", record.frame), record.method, error_text(flicker.mean), error_text(flicker.p99),
                    flicker.noise_floor ? error_text(*flicker.noise_floor) : "n/a"});
  }
  if (rows.empty()) return {};
  return "\n## Flicker\n\n" +
         markdown_table({{"Frame"}, {"Method", false}, {"Mean"}, {"99th percentile"}, {"Floor"}}, rows);
}

/// Effective NDFs of the footprints that were looked into.
std::string ndf_section(const Results& results) {
  if (results.ndf.empty()) return {};
  Rows rows;
  for (const FootprintNdf& figures : results.ndf) {
    rows.push_back({figures.footprint, figures.method, three_figures(figures.l2), three_figures(figures.energy),
                    three_figures(figures.peak), fmt::format("{}", figures.lobes)});
  }
  return "\n## Effective NDFs\n\n" +
         markdown_table({{"Footprint", false}, {"Method", false}, {"Rel. L2"}, {"Energy"}, {"Peak"}, {"Lobes"}}, rows);
}

/// Figures that no picture shows.
std::string quantity_section(const Results& results) {
  if (results.quantities.empty()) return {};
  Rows rows;
  for (const QuantityFigure& figure : results.quantities) {
    rows.push_back({figure.name, figure.method, figure.quantity, fmt::format("{:.3g}", figure.value)});
  }
  return "\n## Other quantities\n\n" +
         markdown_table({{"Name", false}, {"Method", false}, {"Quantity", false}, {"Value"}}, rows);
}

/// Frame builds of methods that have one: they are part of the cost at that distance.
std::string frame_build_section(const Results& results) {
  Rows rows;
  for (const Record& record : results.records) {
    if (!record.frame_build) continue;
    rows.push_back({record.method, fmt::format("{}", record.distance), three_figures(record.frame_build_ms.value_or(0)),
                    std::string(word_for(build_timing_words, *record.frame_build))});
  }
  if (rows.empty()) return {};
  return "\n## Frame build\n\n" +
         markdown_table({{"Method", false}, {"Distance"}, {"Frame build ms"}, {"In frame ms", false}}, rows);
}

/// A few distances of the supersampling curve side by side.
std::string curve_table(const Results& results, std::span<const double> distances) {
  std::vector<MarkdownColumn> columns{{"spp"}};
  for (const double distance : distances) {
    columns.push_back({fmt::format("Error at {}", distance)});
    columns.push_back({"ms"});
  }
  std::map<int, std::vector<std::string>> by_count;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    for (const SupersamplingPoint& point : results.supersampling) {
      if (point.distance != distances[i]) continue;
      std::vector<std::string>& row =
          by_count.try_emplace(point.spp, std::vector<std::string>(columns.size(), "n/a")).first->second;
      row[0] = fmt::format("{}", point.spp);
      if (point.normalized_color) row[1 + 2 * i] = error_text(*point.normalized_color);
      row[2 + 2 * i] = three_figures(point.ms);
    }
  }
  Rows rows;
  for (auto& [spp, row] : by_count) rows.push_back(std::move(row));
  return markdown_table(columns, rows);
}

std::string supersampling_section(const Results& results) {
  if (results.supersampling.empty()) return {};
  constexpr std::size_t side_by_side = 4;
  std::string text = "\n## Plain supersampling\n";
  const std::vector<double> distances = distances_of(results);
  for (std::size_t first = 0; first < distances.size(); first += side_by_side) {
    const std::size_t count = std::min(side_by_side, distances.size() - first);
    text.append("\n").append(curve_table(results, std::span(distances).subspan(first, count)));
  }
  return text;
}

std::string warnings_section(const Results& results) {
  const std::vector<std::string> warnings = ranking_warnings(results);
  if (warnings.empty()) return {};
  std::string text = "\n## Caveats\n\n";
  for (const std::string& warning : warnings) text += list_entry(warning);
  return text;
}

/// The meanings of the columns, with those that only this table has.
std::string notes() {
  std::string text;
  const auto add = [&text](std::string_view title, std::string_view note) {
    text += fmt::format("- {}: {}\n", plain(title), note);
  };
  for (const std::string_view key : {"normalized_color_error", "shading_error", "rank", "edges_error", "filter_error",
                                     "method_error", "light_error", "representation_error", "equivalent_spp"})
    add(column_of(key).title, column_of(key).note);
  add("% of pixels closer than", "interior pixels in which the row's method is closer to the reference, beyond noise.");
  for (const std::string_view key : {"frame_median_ms", "ratio_to_direct_median"})
    add(column_of(key).title, column_of(key).note);
  add("Fetches, Lobes", "texture lookups and lobes per pixel, counted.");
  return text;
}

std::string words_section(const Results& results) {
  std::string text = "\n## Summary\n";
  for (const double distance : distances_of(results)) {
    text += fmt::format("\nDistance {}:\n\n", distance);
    for (const std::string& finding : findings(results, distance)) text += list_entry(finding);
  }
  return text + "\nErrors are normalised colour errors; lower is better.\n\n" + notes();
}

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

std::string results_table(const Results& results) {
  if (results.way) return animation_table(results);
  std::string text = fmt::format("# {}\n\n", markdown_escaped(results.scene.name));
  for (const Provenance& line : provenance(results)) {
    text += fmt::format("- {}: {}\n", line.label, markdown_escaped(line.value));
  }
  text += warnings_section(results);
  if (results.experiment) text += experiment_markdown(*results.experiment);
  for (const double distance : distances_of(results)) text += distance_section(results, distance);
  return text + flicker_section(results) + ndf_section(results) + quantity_section(results) +
         preparation_section(results) + frame_build_section(results) + supersampling_section(results) +
         gpu_costs_markdown(results) + words_section(results);
}

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
