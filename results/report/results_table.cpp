// Results as Markdown tables of at most about 130 columns: errors and times by distance, what each method prepares,
// the supersampling curve, and a sentence on each method. And the text that the program prints: the answer at each
// distance, and a table padded with spaces.
#include "results/report/results_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <sstream>
#include <string_view>
#include <vector>

#include "renderer/core/memory.hpp"
#include "results/report/command_reports.hpp"
#include "results/report/experiment_report.hpp"
#include "results/report/figure_table.hpp"
#include "results/report/figures.hpp"
#include "results/report/page.hpp"
#include "results/report/ranking.hpp"
#include "results/report/report.hpp"

namespace footprint {
namespace {

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

/// "Method", then the columns of the keys; the light's only if there is one. Ranks and shading errors have marks.
Table table_of(std::vector<std::string_view> keys, const DistanceRecords& records) {
  const auto has_light = [](const Record& r) { return r.error && r.error->causes.light; };
  if (!std::ranges::any_of(records, has_light)) std::erase(keys, "light_error");
  const bool any_marked = std::ranges::any_of(records, shading_at_noise_floor);
  Table table{.columns = {{"Method", false}}};
  for (const std::string_view key : keys) table.columns.push_back({plain(figure_of(key).title)});
  for (const Record& record : records) {
    std::vector<std::string>& row = table.rows.emplace_back(1, record.method);
    for (const std::string_view key : keys) {
      row.push_back(key == "rank"            ? rank_text(record, records)
                    : key == "shading_error" ? marked_shading(record, any_marked)
                                             : plain(cell_text(figure_of(key), record)));
    }
  }
  return table;
}

constexpr std::size_t terminal = 130;  // columns

/// One table, or as many as it takes that none is wider than a terminal; each begins with the first column.
std::string split_table(const Table& table) {
  const std::size_t all = table.columns.size();
  const auto part = [&](std::size_t first, std::size_t count) {
    Table some = table;
    const auto cut = [&](auto& cells) {
      const auto begin = cells.begin() + static_cast<std::ptrdiff_t>(first);
      cells.erase(begin + static_cast<std::ptrdiff_t>(count), cells.end());
      cells.erase(cells.begin() + 1, begin);
    };
    cut(some.columns);
    std::ranges::for_each(some.rows, cut);
    return markdown_table(some);
  };
  std::string text;
  for (std::size_t first = 1, count = all - 1; first < all; count = all - first) {
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
  std::string text = markdown_table(whole);
  if (text.find('\n') <= terminal) return text;
  return split_table(table_of(errors, records)) + "\n" + split_table(table_of(times, records));
}

/// Every two methods of a distance pixel by pixel: empty where none were.
std::string pairs_table(const Results& results, const DistanceRecords& records) {
  Table table{.columns = {{"% of pixels closer than", false}}};
  bool any = false;
  for (const Record& record : records) {
    table.columns.push_back({markdown_escaped(record.method)});
    std::vector<std::string>& row = table.rows.emplace_back(1, record.method);
    for (const Record& other : records) {
      const auto share = closer_share(results, record.distance, record.method, other.method);
      any = any || share;
      row.push_back(share ? fmt::format("{:.1f}", 100.0 * *share) : "-");
    }
  }
  return any ? "\n" + split_table(table) : std::string();
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
  Table table{.heading = "Bakes", .columns = {{"Method", false}}};
  for (const std::string_view key : keys) table.columns.push_back({plain(figure_of(key).title)});
  table.columns.insert(table.columns.end(), {{"Cached", false}, {"Effects left out", false}});
  for (const Record& record : results.records) {
    std::vector<std::string> row{record.method};
    for (const std::string_view key : keys) row.push_back(plain(cell_text(figure_of(key), record)));
    row.insert(row.end(), {record.precompute_cached ? "yes" : "no", list_text(record.effects_left_out, "none")});
    if (std::ranges::find(table.rows, row) == table.rows.end()) table.rows.push_back(std::move(row));
  }
  return markdown_section(table);
}

std::string flicker_section(const Results& results) {
  Table table{.heading = "Flicker",
              .columns = {{"Frame"}, {"Method", false}, {"Mean"}, {"99th percentile"}, {"Floor"}}};
  for (const Record& record : results.records) {
    if (!record.flicker) continue;
    const Flicker& flicker = *record.flicker;
    table.rows.push_back({fmt::format("{}", record.frame), record.method, error_text(flicker.mean),
                          error_text(flicker.p99), error_text(flicker.noise_floor)});
  }
  return markdown_section(table);
}

std::string ndf_section(const Results& results) {
  Table table{.heading = "Effective NDFs",
              .columns = {{"Footprint", false}, {"Method", false}, {"Rel. L2"}, {"Energy"}, {"Peak"}, {"Lobes"}}};
  for (const FootprintNdf& figures : results.ndf) {
    table.rows.push_back({figures.footprint, figures.method, three_figures(figures.l2), three_figures(figures.energy),
                          three_figures(figures.peak), fmt::format("{}", figures.lobes)});
  }
  return markdown_section(table);
}

std::string quantity_section(const Results& results) {
  Table table{.heading = "Other quantities",
              .columns = {{"Name", false}, {"Method", false}, {"Quantity", false}, {"Value"}}};
  for (const QuantityFigure& figure : results.quantities)
    table.rows.push_back({figure.name, figure.method, figure.quantity, fmt::format("{:.3g}", figure.value)});
  return markdown_section(table);
}

/// Frame builds of methods that have one: they are part of the cost at that distance.
std::string frame_build_section(const Results& results) {
  Table table{.heading = "Frame build",
              .columns = {{"Method", false}, {"Distance"}, {"Frame build ms"}, {"In frame ms", false}}};
  for (const Record& record : results.records) {
    if (!record.frame_build) continue;
    table.rows.push_back({record.method, fmt::format("{}", record.distance),
                          three_figures(record.frame_build_ms.value_or(0)),
                          std::string(word_for(build_timing_words, *record.frame_build))});
  }
  return markdown_section(table);
}

/// A few distances of the supersampling curve side by side.
std::string curve_table(const Results& results, std::span<const double> distances) {
  Table table{.columns = {{"spp"}}};
  for (const double distance : distances)
    table.columns.insert(table.columns.end(), {{fmt::format("Error at {}", distance)}, {"ms"}});
  std::map<int, std::vector<std::string>> by_count;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    for (const SupersamplingPoint& point : results.supersampling) {
      if (point.distance != distances[i]) continue;
      std::vector<std::string>& row =
          by_count.try_emplace(point.spp, std::vector<std::string>(table.columns.size(), "n/a")).first->second;
      row[0] = fmt::format("{}", point.spp);
      if (point.normalized_color) row[1 + 2 * i] = error_text(*point.normalized_color);
      row[2 + 2 * i] = three_figures(point.ms);
    }
  }
  for (auto& [spp, row] : by_count) table.rows.push_back(std::move(row));
  return markdown_table(table);
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
    text += list_entry(fmt::format("{}: {}", plain(title), plain(note)));
  };
  for (const std::string_view key : {"normalized_color_error", "shading_error", "rank", "edges_error", "filter_error",
                                     "method_error", "light_error", "representation_error", "equivalent_spp"})
    add(figure_of(key).title, figure_of(key).meaning);
  add("% of pixels closer than", "Interior pixels in which the row's method is closer to the reference, beyond noise.");
  for (const std::string_view key : {"frame_median_ms", "ratio_to_direct_median"})
    add(figure_of(key).title, figure_of(key).meaning);
  add("Fetches, Lobes", "Texture lookups and lobes per pixel, counted.");
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

struct MeanColumn {
  const char *title, *key;  // its heading, and the figure
  bool is_largest = false;  // not the mean
};

constexpr std::array<MeanColumn, 7> mean_columns{{{"Error", "normalized_color_error"},
                                                  {"Floor", "noise_floor"},
                                                  {"Flicker", "flicker"},
                                                  {"Worst frame", "flicker", true},
                                                  {"99th perc.", "flicker_p99"},
                                                  {"Flicker floor", "flicker_noise_floor"},
                                                  {"Highlights", "highlight_energy"}}};
constexpr std::array<MeanColumn, 8> cause_columns{{{"Shading", "flicker_shading"},
                                                   {"p99", "flicker_shading_p99"},
                                                   {"Edges", "flicker_edges"},
                                                   {"p99", "flicker_edges_p99"},
                                                   {"Filter", "flicker_filter"},
                                                   {"p99", "flicker_filter_p99"},
                                                   {"Method's own", "flicker_method"},
                                                   {"p99", "flicker_method_p99"}}};

/// Over the frames of a method that have the figure; "n/a" without any.
std::string mean_text(const std::vector<Record>& records, const std::string& method, const MeanColumn& column) {
  std::vector<double> figures;
  for (const Record& record : records) {
    if (record.method != method) continue;
    const std::optional<double> figure = figure_of(column.key).of(record);
    if (figure && std::isfinite(*figure)) figures.push_back(*figure);
  }
  if (figures.empty()) return "n/a";
  return error_text(column.is_largest
                        ? std::ranges::max(figures)
                        : std::accumulate(figures.begin(), figures.end(), 0.0) / static_cast<double>(figures.size()));
}

std::string means_table(const std::vector<Record>& records, const std::vector<std::string>& methods,
                        std::span<const MeanColumn> columns) {
  Table table{.columns = {{"Method", false}}};
  for (const MeanColumn& column : columns) table.columns.push_back({column.title});
  for (const std::string& method : methods) {
    std::vector<std::string>& row = table.rows.emplace_back(1, method);
    for (const MeanColumn& column : columns) row.push_back(mean_text(records, method, column));
  }
  return markdown_table(table);
}

using Row = std::vector<std::string>;

// The error of one frame of `direct`, even if it is not a row: it is the first point of the supersampling curve.
std::optional<double> error_of_direct(const Results& results, double distance) {
  for (const SupersamplingPoint& point : results.supersampling) {
    if (point.distance == distance && point.spp == 1) return point.shading;
  }
  for (const Record& record : results.records) {
    if (record.distance == distance && is_unit_frame(record)) return ranked_error(record);
  }
  return {};
}

// "-59%"; empty where there is nothing to compare with.
std::string change_text(const std::optional<double>& error, const std::optional<double>& direct) {
  if (!error || !direct || *direct <= 0) return {};
  return fmt::format("{:+.0f}%", 100.0 * (*error / *direct - 1.0));
}

// The least error first, then those without one in the order of the run.
DistanceRecords sorted_records(const Results& results, double distance) {
  DistanceRecords records = records_at(results, distance);
  std::ranges::stable_sort(records, {}, [](const Record& r) { return ranked_error(r).value_or(INFINITY); });
  return records;
}

std::string cost_phrase(const Record& record) {
  const TimeRatio& cost = record.ratio_to_direct;
  return std::isfinite(cost.median) ? fmt::format("{} times the frame time of direct", three_figures(cost.median))
                                    : std::string("an unknown frame time");
}

std::string most_accurate(const DistanceRecords& best, const std::optional<double>& direct) {
  const Record& first = best.front();
  const Record& cheapest = *std::ranges::min_element(best, {}, [](const Record& r) { return r.frame_ms.median; });
  std::vector<std::string> names;
  for (const Record& record : best) names.push_back(record.method);
  std::string text =
      best.size() == 1
          ? fmt::format("{} is the most accurate: error {}", names.front(), error_text(*ranked_error(first)))
          : fmt::format("{} are the most accurate, with no difference beyond the reference's noise: error {}",
                        fmt::join(names, ", "), range_text(*ranked_error(first), *ranked_error(best.back())));
  const std::string change = change_text(ranked_error(first), direct);
  if (!change.empty() && !is_unit_frame(first)) text += fmt::format(" ({} against direct)", change);
  if (is_unit_frame(cheapest)) return text + ".";
  return text + fmt::format(", at {}{}.", cost_phrase(cheapest),
                            best.size() == 1 ? "" : fmt::format(" with {}", cheapest.method));
}

// The cheapest one that is better than `direct` beyond noise; null where that is among `best`, or unknown.
const Record* cheapest_gain(const DistanceRecords& records, const DistanceRecords& best) {
  const auto direct = std::ranges::find_if(records, is_unit_frame);
  if (direct == records.end()) return nullptr;
  const Record* cheapest = nullptr;
  for (const Record& record : records) {
    if (is_better(record, *direct) && (!cheapest || record.frame_ms.median < cheapest->frame_ms.median))
      cheapest = &record;
  }
  const bool is_best = std::ranges::any_of(best, [&](const Record& r) { return &r == cheapest; });
  return is_best ? nullptr : cheapest;
}

// Hundredths are the least that a bake's time is good for.
std::string seconds_text(double seconds) {
  if (seconds < 0.01) return "<0.01 s";
  return seconds < 9.995 ? fmt::format("{:.2f} s", seconds) : fmt::format("{} s", three_figures(seconds));
}

Row row_of(const Results& results, const Record& record) {
  const std::optional<double> error = ranked_error(record);
  return {fmt::format("{:g}", record.distance),
          record.method,
          record.failure ? "failed"
          : error        ? error_text(*error) + (shading_at_noise_floor(record) ? " *" : "  ")
                         : "n/a",
          change_from_direct(results, record),
          record.failure ? std::string() : equivalent_text(record),
          record.failure ? std::string() : ratio_text(record.ratio_to_direct),
          record.failure ? std::string() : readable_bytes(record.precompute_bytes),
          record.failure ? std::string() : seconds_text(record.precompute_seconds)};
}

// Two spaces between columns; the method's name to the left, all else to the right.
std::string aligned(const std::vector<Row>& rows) {
  const auto name = static_cast<std::size_t>(std::ranges::find(rows.front(), "Method") - rows.front().begin());
  std::vector<std::size_t> widths(rows.front().size());
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i)
      line += i == name ? fmt::format("  {:<{}}", row[i], widths[i]) : fmt::format("  {:>{}}", row[i], widths[i]);
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

std::string summary_table(const Results& results) {
  std::vector<Row> rows{{"Distance", "Method", "Error  ", "vs direct", "= supersampling at", "Cost", "Memory", "Bake"}};
  for (const double distance : distances_of(results)) {
    for (const Record& record : sorted_records(results, distance)) rows.push_back(row_of(results, record));
  }
  if (distances_of(results).size() == 1) {
    for (Row& row : rows) row.erase(row.begin());
  }
  return aligned(rows);
}

// The line above the table: the values that all rows share.
std::string head(const Results& results) {
  const Record& first = results.records.front();
  return fmt::format("{}: {}x{}, footprint filter {}, reference {} samples per pixel\n", results.scene.name,
                     first.width, first.height, results.footprint, three_figures(results.reference.samples));
}

std::string legend(const Results& results) {
  const bool any_marked = std::ranges::any_of(results.records, shading_at_noise_floor);
  return fmt::format(
      "  Error: mean colour difference from the reference, 0 to 1, over interior pixels; lower is better.\n"
      "  = supersampling at: samples per pixel of plain supersampling with the same error.\n"
      "  Cost: frame time over that of direct: median, and the 95% interval of the median;\n"
      "  {}.\n{}",
      timing_text(results.timing), any_marked ? "  *: at the noise floor of the reference.\n" : "");
}

std::string summary_notes(const Results& results) {
  std::vector<std::string> all = ranking_warnings(results);
  all.insert(all.end(), results.scene.warnings.begin(), results.scene.warnings.end());
  for (const std::string& supplied : results.scene.defaults) all.push_back("supplied: " + supplied);
  std::string text;
  for (const std::string& note : all) text += fmt::format("  note: {}\n", note);
  return text.empty() ? text : "\n" + text;
}

}  // namespace

std::string results_table(const Results& results) {
  if (results.animation) return animation_table(results);
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
  if (results.animation->path == "zoom")
    return fmt::format("a zoom from distance {:g} to {:g}", first.distance, last.distance);
  if (results.animation->path == "animation")
    return fmt::format("its animation from {:g} to {:g} s at distance {:g}", first.seconds, last.seconds,
                       last.distance);
  return fmt::format("{} by {:g} degrees at distance {:g}",
                     results.animation->path == "orbit" ? "an orbit" : "the lights turn", last.degrees, last.distance);
}

std::string animation_table(const Results& results) {
  const std::vector<std::string> methods = methods_in_order(results.records);
  const std::vector<Record>& records = results.records;
  std::string text = fmt::format("# {}, {} frames: {}\n\n", markdown_escaped(results.scene.name),
                                 results.records.size() / methods.size(), path_words(results)) +
                     means_table(records, methods, mean_columns) +
                     fmt::format(R"(
Error: normalised colour error against the reference, mean over the frames. Flicker: how much the change since the
previous frame differs from the reference's, mean over the object's pixels and the frames, and 99th percentile over the
pixels. Floors: the part that the reference's own noise causes. Highlights: exposed luminance above 0.8, mean over the
pixels; {} in the reference.

Flicker by cause, mean and 99th percentile:

)",
                                 mean_text(records, methods.front(), {"", "reference_highlight_energy"})) +
                     means_table(records, methods, cause_columns) +
                     R"(
Shading: pixels that are interior in both frames. Edges: the object's other pixels. Filter: flicker of the exact sum
under the same footprint filter. Method's own: flicker of the image compared with that sum.
)";
  std::vector<std::string> warnings = ranking_warnings(results);
  warnings.insert(warnings.end(), results.scene.warnings.begin(), results.scene.warnings.end());
  for (const std::string& warning : warnings) text += fmt::format("\nWarning: {}.\n", markdown_escaped(warning));
  return text;
}

DistanceAnswer answer_at(const Results& results, double distance) {
  const DistanceRecords records = sorted_records(results, distance);
  if (!ranked_error(records.front())) return {.sentences = {"no method is ranked."}};
  DistanceRecords best;
  std::ranges::copy_if(records, std::back_inserter(best),
                       [&](const Record& r) { return ranked_error(r) && !is_better(records.front(), r); });
  DistanceAnswer answer{.sentences = {most_accurate(best, error_of_direct(results, distance))}};
  const Record* const cheapest = cheapest_gain(records, best);
  if (cheapest) {
    answer.sentences.push_back(fmt::format("{} is the cheapest that improves on direct: error {}, at {}.",
                                           cheapest->method, error_text(*ranked_error(*cheapest)),
                                           cost_phrase(*cheapest)));
  }
  const auto direct = std::ranges::find_if(records, is_unit_frame);
  if (direct != records.end() && &direct->get() != &best.front().get()) answer.methods.emplace_back("direct");
  if (cheapest) answer.methods.push_back(cheapest->method);
  answer.methods.push_back(best.front().get().method);
  return answer;
}

std::string change_from_direct(const Results& results, const Record& record) {
  if (is_unit_frame(record)) return {};
  return change_text(ranked_error(record), error_of_direct(results, record.distance));
}

std::string results_summary(const Results& results) {
  if (results.records.empty()) return {};
  std::string text = head(results) + "\n";
  for (const double distance : distances_of(results))
    text += fmt::format("  Distance {:g}: {}\n", distance, fmt::join(answer_at(results, distance).sentences, "\n    "));
  text += "\n" + summary_table(results) + "\n" + legend(results) + summary_notes(results);
  if (results.experiment) text += experiment_markdown(*results.experiment);
  return text;
}

}  // namespace footprint
