// Baselines as JSON, and what differs.
#include "results/report/baseline.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

constexpr const char* schema = "footprint-baseline/1";

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

// How a figure differs; none where it does not.
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
      {"schema", schema}, {"tolerance", baseline.tolerance}, {"figures", baseline.figures}};
  return document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

Baseline parse_baseline(const std::string& text, const std::string& place) {
  const auto refuse = [&](const std::string& why) {
    throw Error(ErrorKind::usage, place, why, "delete it and use --update-baseline to write a new one");
  };
  Baseline baseline;
  try {
    const nlohmann::json document = nlohmann::json::parse(text);
    if (!document.is_object() || document.value("schema", "") != schema)
      refuse(fmt::format("is not a baseline of format {}", schema));
    baseline.tolerance = document.at("tolerance");
    baseline.figures = document.at("figures").get<BaselineFigures>();
  } catch (const nlohmann::json::exception&) {
    refuse("is damaged");
  }
  if (!(baseline.tolerance >= 0.0)) refuse("has a tolerance below 0");
  return baseline;
}

std::vector<CheckOutcome> held_against(const Baseline& baseline, const BaselineFigures& now, const std::string& file) {
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
