// Outcomes as text, each format with its own escapes; baselines as JSON, and their differences.
#include "results/report/check_outcomes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string_view>

#include "renderer/core/error.hpp"
#include "results/report/page.hpp"

namespace footprint {
namespace {

// XML 1.0: characters that no document may contain, not even escaped, become blanks.
std::string xml_escaped(std::string_view text) {
  std::string out;
  for (const char c : html_escaped(text)) {
    if (c == '\n')
      out += "&#10;";
    else
      out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out;
}

// As workflow commands take them: a property also ends at a comma, and its name at a colon.
std::string command_escaped(std::string_view text, bool is_property) {
  std::string out;
  for (const char c : text) {
    const bool special = c == '%' || c == '\r' || c == '\n' || (is_property && (c == ':' || c == ','));
    out += special ? fmt::format("%{:02X}", static_cast<unsigned>(c)) : std::string(1, c);
  }
  return out;
}

// FILE:LINE, or FILE, as properties of a workflow command.
std::string place_property(const std::string& place) {
  if (place.empty()) return {};
  const std::size_t colon = place.rfind(':');
  const bool has_line = colon != std::string::npos && colon + 1 < place.size() &&
                        place.find_first_not_of("0123456789", colon + 1) == std::string::npos;
  const std::string file = command_escaped(has_line ? place.substr(0, colon) : place, true);
  return has_line ? fmt::format("file={},line={},", file, place.substr(colon + 1)) : fmt::format("file={},", file);
}

std::string test_case(const CheckOutcome& outcome) {
  const std::string head =
      fmt::format(R"(    <testcase classname="{}" name="{}")", xml_escaped(outcome.suite), xml_escaped(outcome.name));
  if (outcome.failure.empty()) return head + "/>\n";
  return head + fmt::format(">\n      <failure message=\"{0}\">{0}</failure>\n    </testcase>\n",
                            xml_escaped(outcome.failure));
}

std::size_t failures_among(std::span<const CheckOutcome> outcomes) {
  return static_cast<std::size_t>(
      std::ranges::count_if(outcomes, [](const CheckOutcome& outcome) { return !outcome.failure.empty(); }));
}

constexpr const char* baseline_schema = "footprint-baseline/1";

using Figures = std::map<std::string, double>;
using Records = std::map<std::string, Figures>;

template <class Map>
const typename Map::mapped_type* find(const Map& map, const std::string& key) {
  const auto found = map.find(key);
  return found == map.end() ? nullptr : &found->second;
}

template <class Map>
void add_keys(const Map& map, std::set<std::string>& keys) {
  for (const auto& [key, value] : map) keys.insert(key);
}

// The difference of a figure in words; none without one.
std::optional<std::string> difference(const std::string& name, const double* before, const double* now,
                                      double tolerance) {
  if (before == nullptr) return fmt::format("{} {:.6g}, missing in the baseline", name, *now);
  if (now == nullptr) return fmt::format("{} is missing, was {:.6g}", name, *before);
  const double allowed = name == "bytes" ? 0.0 : tolerance;
  if (std::abs(*now - *before) <= allowed) return {};
  return fmt::format("{} {:.6g}, was {:.6g}", name, *now, *before);
}

std::string differences(const Figures* before, const Figures* now, double tolerance) {
  if (before == nullptr) return "this record is missing in the baseline";
  if (now == nullptr) return "this record is missing in the run";
  std::set<std::string> names;
  add_keys(*before, names);
  add_keys(*now, names);
  std::string text;
  for (const std::string& name : names) {
    const auto found = difference(name, find(*before, name), find(*now, name), tolerance);
    if (found) text += (text.empty() ? "" : "; ") + *found;
  }
  return text;
}

}  // namespace

std::vector<CheckOutcome> check_outcomes(const ExperimentReport& report) {
  std::vector<CheckOutcome> outcomes;
  for (const ClaimOutcome& claim : report.claims) {
    outcomes.push_back({.suite = report.name,
                        .name = "claim " + claim.name,
                        .failure = claim.as_expected() ? "" : shortfall_of(claim),
                        .place = claim.place});
  }
  for (const ThresholdOutcome& threshold : report.thresholds) {
    outcomes.push_back({.suite = report.name,
                        .name = "threshold " + threshold.measure,
                        .failure = threshold.passed() ? "" : shortfall_of(threshold),
                        .place = threshold.place});
  }
  return outcomes;
}

std::vector<std::string> shortfalls_of(std::span<const CheckOutcome> outcomes) {
  std::vector<std::string> lines;
  for (const CheckOutcome& outcome : outcomes) {
    if (!outcome.failure.empty()) lines.push_back(outcome.name + ": " + outcome.failure);
  }
  return lines;
}

std::string junit_xml(std::span<const CheckOutcome> outcomes) {
  std::string xml =
      fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites tests=\"{}\" failures=\"{}\">\n",
                  outcomes.size(), failures_among(outcomes));
  while (!outcomes.empty()) {
    const auto end = std::ranges::find_if(
        outcomes, [&](const CheckOutcome& outcome) { return outcome.suite != outcomes.front().suite; });
    const auto suite = outcomes.first(static_cast<std::size_t>(end - outcomes.begin()));
    xml += fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\">\n", xml_escaped(suite.front().suite),
                       suite.size(), failures_among(suite));
    for (const CheckOutcome& outcome : suite) xml += test_case(outcome);
    xml += "  </testsuite>\n";
    outcomes = outcomes.subspan(suite.size());
  }
  return xml + "</testsuites>\n";
}

std::string github_annotations(std::span<const CheckOutcome> outcomes) {
  std::string text;
  for (const CheckOutcome& outcome : outcomes) {
    if (outcome.failure.empty()) continue;
    text += fmt::format("::error {}title={}::{}\n", place_property(outcome.place),
                        command_escaped(outcome.suite + ": " + outcome.name, true),
                        command_escaped(outcome.failure, false));
  }
  return text;
}

BaselineFigures baseline_figures(const Results& results) {
  BaselineFigures figures;
  Records& records = figures[results.experiment ? results.experiment->name : results.scene.name];
  for (const Record& record : results.records) {
    Figures& own = records[fmt::format("{} at {}", record.method, record.distance)];
    own["bytes"] = static_cast<double>(record.precompute_bytes);
    if (record.error) own["error"] = record.error->normalized_color;
    if (record.error && record.error->causes.shading) own["shading"] = *record.error->causes.shading;
    if (record.flicker) own["flicker"] = record.flicker->mean;
  }
  return figures;
}

std::string baseline_json(const Baseline& baseline) {
  const nlohmann::ordered_json document{
      {"schema", baseline_schema}, {"tolerance", baseline.tolerance}, {"figures", baseline.figures}};
  return document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

Baseline parse_baseline(const std::string& text, const std::string& place) {
  const auto refuse = [&](const std::string& why) {
    throw Error(ErrorKind::usage, place, why, "delete it and use --update-baseline to write a new one");
  };
  Baseline baseline;
  try {
    const nlohmann::json document = nlohmann::json::parse(text);
    if (!document.is_object() || document.value("schema", "") != baseline_schema)
      refuse(fmt::format("is not a baseline of format {}", baseline_schema));
    baseline.tolerance = document.at("tolerance");
    baseline.figures = document.at("figures").get<BaselineFigures>();
  } catch (const nlohmann::json::exception&) {
    refuse("is damaged");
  }
  if (!(baseline.tolerance >= 0.0)) refuse("has a tolerance below 0");
  return baseline;
}

std::vector<CheckOutcome> compare_with_baseline(const Baseline& baseline, const BaselineFigures& now,
                                                const std::string& file) {
  static const Records none;
  std::vector<CheckOutcome> outcomes;
  for (const auto& [experiment, records] : now) {
    const Records* const known = find(baseline.figures, experiment);
    const Records& before = known == nullptr ? none : *known;
    std::set<std::string> names;
    add_keys(before, names);
    add_keys(records, names);
    for (const std::string& name : names) {
      outcomes.push_back({.suite = experiment,
                          .name = "baseline " + name,
                          .failure = differences(find(before, name), find(records, name), baseline.tolerance),
                          .place = file});
    }
  }
  return outcomes;
}

}  // namespace footprint
