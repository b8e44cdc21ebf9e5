// Results as Markdown tables of at most about 130 columns: errors and times by distance, what each method prepares,
// the supersampling curve, and a sentence on each method.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <span>

#include "renderer/core/memory.hpp"
#include "results/report/experiment_section.hpp"
#include "results/report/figures.hpp"
#include "results/report/markdown_table.hpp"
#include "results/report/report.hpp"

namespace footprint {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::vector<std::reference_wrapper<const Record>> records_at(const Results& results, double distance) {
  std::vector<std::reference_wrapper<const Record>> records;
  std::ranges::copy_if(results.records, std::back_inserter(records),
                       [distance](const Record& r) { return r.distance == distance; });
  return records;
}

/// The error with its mark; unmarked ones keep its room, so that the figures stand under each other.
std::string marked_error(const Record& record, bool any_marked) {
  if (!record.error) return "n/a";
  const std::string_view mark = at_noise_floor(record) ? " *" : any_marked ? "  " : "";
  return error_text(record.error->normalized_color).append(mark);
}

std::vector<std::string> main_row(const Record& record, bool any_marked) {
  const auto figure = [&record](auto member) -> std::string {
    return record.error ? error_text((*record.error).*member) : "n/a";
  };
  const bool floor_known = record.error && record.error->noise_floor;
  const FrameTime& frame = record.frame_ms;
  const TimeRatio& ratio = record.ratio_to_direct;
  return {record.method,
          marked_error(record, any_marked),
          floor_known ? error_text(*record.error->noise_floor) : "n/a",
          figure(&RecordError::representation),
          figure(&RecordError::filtering),
          equivalent_text(record),
          spread_text(frame.median, frame.minimum, frame.p90),
          spread_text(ratio.median, ratio.minimum, ratio.maximum),
          three_figures(record.fps)};
}

/// Rows cut to their first column and `count` more from `first` on.
Rows cut(const Rows& rows, std::size_t first, std::size_t count) {
  Rows parts;
  for (const std::vector<std::string>& row : rows) {
    std::vector<std::string>& part = parts.emplace_back(1, row[0]);
    part.insert(part.end(), row.begin() + static_cast<std::ptrdiff_t>(first),
                row.begin() + static_cast<std::ptrdiff_t>(first + count));
  }
  return parts;
}

/// One table; errors and times in two where long method names would make it wider than a terminal.
std::string main_table(const Rows& rows) {
  constexpr std::size_t terminal = 130;
  const std::vector<MarkdownColumn> errors{{"Method", false}, {"Error"},   {"Floor"},
                                           {"Repr."},         {"Filter."}, {"Worth spp"}};
  const std::vector<MarkdownColumn> times{{"Method", false}, {"Frame ms"}, {"x direct"}, {"fps"}};
  std::vector<MarkdownColumn> all = errors;
  all.insert(all.end(), times.begin() + 1, times.end());
  std::string whole = markdown_table(all, rows);
  if (whole.find('\n') <= terminal) return whole;
  return markdown_table(errors, cut(rows, 1, errors.size() - 1)) + "\n" +
         markdown_table(times, cut(rows, errors.size(), times.size() - 1));
}

std::string distance_section(const Results& results, double distance) {
  const auto records = records_at(results, distance);
  const bool any_marked = std::ranges::any_of(records, at_noise_floor);
  Rows rows;
  for (const Record& record : records) rows.push_back(main_row(record, any_marked));
  return fmt::format("\n## Distance {}\n\n{}{}", distance, main_table(rows),
                     any_marked ? "\n\\* at the noise floor: the reference's own noise explains this error.\n" : "");
}

/// What does not depend on the distance: one line a method, more only where its figures differ.
std::string preparation_section(const Results& results) {
  const std::vector<MarkdownColumn> columns{{"Method", false}, {"Precompute s"},  {"Maps"},
                                            {"B/texel"},       {"Cached", false}, {"Effects left out", false}};
  Rows rows;
  for (const Record& record : results.records) {
    std::vector<std::string> row{record.method,
                                 three_figures(record.precompute_seconds),
                                 readable_bytes(record.precompute_bytes),
                                 bytes_per_texel_text(record),
                                 record.precompute_cached ? "yes" : "no",
                                 list_text(record.effects_left_out, "none")};
    if (std::ranges::find(rows, row) == rows.end()) rows.push_back(std::move(row));
  }
  return "\n## What each method prepares\n\n" + markdown_table(columns, rows);
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
  return "\n## Flicker against the frame before\n\n" +
         markdown_table({{"Frame"}, {"Method", false}, {"Mean"}, {"99th percentile"}, {"Floor"}}, rows);
}

/// Effective NDFs of the footprints that were looked into.
std::string ndf_section(const Results& results) {
  if (results.ndf.empty()) return {};
  Rows rows;
  for (const NdfFigures& figures : results.ndf) {
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
  return "\n## Figures that no picture shows\n\n" +
         markdown_table({{"Name", false}, {"Method", false}, {"Figure", false}, {"Value"}}, rows);
}

/// Frame builds, where a method has one: they are part of its price at that distance.
std::string frame_build_section(const Results& results) {
  Rows rows;
  for (const Record& record : results.records) {
    if (!record.frame_build) continue;
    const auto [ms, timing] = *record.frame_build;
    rows.push_back(
        {record.method, fmt::format("{}", record.distance), three_figures(ms), std::string(timing_name(timing))});
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

std::string words_section(const Results& results) {
  std::string text = "\n## In words\n\n";
  for (const Record& record : results.records) text += fmt::format("- {}\n", markdown_escaped(reading(record)));
  return text + R"(
Error: normalised colour error, mean over the object's pixels. Floor: the part of it that the reference's own noise
causes. Repr.: the error of the method's finest level, supersampled. Filter.: that of the method against its own
supersampled finest level. Worth spp: the samples a pixel at which plain supersampling has the same error. Frame ms:
median (least-90th percentile). x direct: frame time over that of `direct`, median (least-most).
)";
}

}  // namespace

std::string results_table(const Results& results) {
  std::string text = fmt::format("# {}\n\n", markdown_escaped(results.scene.name));
  for (const Provenance& line : provenance(results)) {
    text += fmt::format("- {}: {}\n", line.label, markdown_escaped(line.value));
  }
  if (results.experiment) text += experiment_markdown(*results.experiment);
  for (const double distance : distances_of(results)) text += distance_section(results, distance);
  return text + flicker_section(results) + ndf_section(results) + quantity_section(results) +
         preparation_section(results) + frame_build_section(results) + supersampling_section(results) +
         words_section(results);
}

}  // namespace footprint
