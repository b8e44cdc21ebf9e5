// Sentences from the ranking, and a table padded with spaces.
#include "results/report/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "renderer/core/memory.hpp"
#include "results/report/experiment_report.hpp"
#include "results/report/figures.hpp"
#include "results/report/ranking.hpp"

namespace footprint {
namespace {

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

std::string table(const Results& results) {
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

std::string notes(const Results& results) {
  std::vector<std::string> all = ranking_warnings(results);
  all.insert(all.end(), results.scene.warnings.begin(), results.scene.warnings.end());
  for (const std::string& supplied : results.scene.defaults) all.push_back("supplied: " + supplied);
  std::string text;
  for (const std::string& note : all) text += fmt::format("  note: {}\n", note);
  return text.empty() ? text : "\n" + text;
}

}  // namespace

DistanceAnswer answer_at(const Results& results, double distance) {
  const DistanceRecords records = sorted_records(results, distance);
  if (!ranked_error(records.front())) return {.sentences = {"no method is ranked."}, .methods = {}};
  DistanceRecords best;
  std::ranges::copy_if(records, std::back_inserter(best),
                       [&](const Record& r) { return ranked_error(r) && !is_better(records.front(), r); });
  DistanceAnswer answer{.sentences = {most_accurate(best, error_of_direct(results, distance))}, .methods = {}};
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
  text += "\n" + table(results) + "\n" + legend(results) + notes(results);
  if (results.experiment) text += experiment_markdown(*results.experiment);
  return text;
}

}  // namespace footprint
