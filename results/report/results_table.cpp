// Results as Markdown tables of at most about 130 columns: errors and times by distance, what each method prepares,
// the supersampling curve, and a sentence on each method.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <span>
#include <sstream>

#include "renderer/core/memory.hpp"
#include "results/report/animation_table.hpp"
#include "results/report/experiment_section.hpp"
#include "results/report/figures.hpp"
#include "results/report/markdown_table.hpp"
#include "results/report/ranking.hpp"
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

/// The pixels that the shading error is over, marked where they are few.
std::string pixels_text(const Record& record) {
  return fmt::format("{}{}", record.pixels.interior, record.pixels.interior < few_pixels ? " !" : "");
}

/// The shading error with its mark; unmarked ones keep its room, so that the figures stand under each other.
std::string marked_shading(const Record& record, bool any_marked) {
  if (!record.error) return "n/a";
  const std::string_view mark = shading_at_noise_floor(record) ? " *" : any_marked ? "  " : "";
  return error_text(record.error->causes.shading).append(mark);
}

bool has_light(const DistanceRecords& records) {
  return std::ranges::any_of(records, [](const Record& r) { return r.error && r.error->causes.light; });
}

std::vector<std::string> error_row(const Record& record, const DistanceRecords& records) {
  const auto cause = [&record](auto member) { return record.error ? error_text(record.error->causes.*member) : "n/a"; };
  std::vector<std::string> row{record.method,
                               rank_text(record, records),
                               record.error ? error_text(record.error->normalized_color) : "n/a",
                               marked_shading(record, std::ranges::any_of(records, shading_at_noise_floor)),
                               cause(&ErrorCauses::edges),
                               cause(&ErrorCauses::filter),
                               cause(&ErrorCauses::method)};
  if (has_light(records)) row.push_back(cause(&ErrorCauses::light));
  row.push_back(record.error ? error_text(record.error->representation) : "n/a");
  row.push_back(equivalent_text(record));
  row.push_back(pixels_text(record));
  return row;
}

std::vector<MarkdownColumn> error_columns(const DistanceRecords& records) {
  std::vector<MarkdownColumn> columns{{"Method", false}, {"Rank"},   {"Error"},    {"Shading"},
                                      {"Edges"},         {"Filter"}, {"Own error"}};
  if (has_light(records)) columns.push_back({"Light"});
  for (const char* title : {"Lobe fit", "= spp", "Pixels"}) columns.push_back({title});
  return columns;
}

std::vector<std::string> time_row(const Record& record) {
  const FrameTime& frame = record.frame_ms;
  return {spread_text(frame.median, frame.minimum, frame.p90), ratio_text(record.ratio_to_direct),
          three_figures(record.fps), record.fetches ? three_figures(*record.fetches) : "-",
          record.lobes ? three_figures(*record.lobes) : "-"};
}

constexpr std::size_t terminal = 130;  // columns

/// One table, or as many as it takes that none is wider than a terminal; each begins with the first column.
std::string split_table(const std::vector<MarkdownColumn>& columns, const Rows& rows) {
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

/// Errors and times of a distance: in one table where it fits, else each in its own.
std::string main_table(const DistanceRecords& records) {
  const std::vector<MarkdownColumn> errors = error_columns(records);
  const std::vector<MarkdownColumn> times{{"Frame ms"}, {"x direct"}, {"fps"}, {"Fetches"}, {"Lobes"}};
  Rows error_rows, time_rows, whole_rows;
  for (const Record& record : records) {
    error_rows.push_back(error_row(record, records));
    time_rows.push_back(time_row(record));
    whole_rows.push_back(error_rows.back());
    whole_rows.back().insert(whole_rows.back().end(), time_rows.back().begin(), time_rows.back().end());
    time_rows.back().insert(time_rows.back().begin(), record.method);
  }
  std::vector<MarkdownColumn> all = errors, named_times = times;
  all.insert(all.end(), times.begin(), times.end());
  named_times.insert(named_times.begin(), errors.front());
  std::string whole = markdown_table(all, whole_rows);
  if (whole.find('\n') <= terminal) return whole;
  return split_table(errors, error_rows) + "\n" + split_table(named_times, time_rows);
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
  return any ? "\n" + split_table(columns, rows) : std::string();
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

/// What does not depend on the distance: one line a method, more only where its figures differ.
std::string preparation_section(const Results& results) {
  const std::vector<MarkdownColumn> columns{{"Method", false}, {"Bake s"},        {"Maps"},
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

/// Frame builds, where a method has one: they are part of its price at that distance.
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

std::string words_section(const Results& results) {
  std::string text = "\n## Summary\n";
  for (const double distance : distances_of(results)) {
    text += fmt::format("\nDistance {}:\n\n", distance);
    for (const std::string& finding : findings(results, distance)) text += list_entry(finding);
  }
  return text + R"(
Errors are normalised colour errors; lower is better.

- Error: mean over the object's pixels.
- Shading: mean over interior pixels, in which the reference sees one smooth piece of surface; `Pixels` counts them.
- Rank: by the shading error; methods that differ by no more than the reference's noise share a rank (=).
- Edges: mean over the object's other pixels, which no method filters.
- Filter: shading error of the exact normal distribution under the same footprint filter.
- Own error: difference between the method's image and that.
- Light: error of its environment lookup, compared with the whole environment.
- Lobe fit: error of the method's finest level, supersampled. It remains without any filtering.
- = spp: samples per pixel of plain supersampling with the same shading error.
- % of pixels closer than: interior pixels in which the row's method is closer to the reference, beyond noise.
- Frame ms: median (minimum-90th percentile).
- x direct: frame time over that of `direct`: median (95% interval of the median).
- Fetches, Lobes: texture lookups and lobes per pixel, counted.
)";
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
         words_section(results);
}

}  // namespace footprint
