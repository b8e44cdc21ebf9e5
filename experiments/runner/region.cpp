// Moves an experiment with its claims to each point of a grid: distances by a factor, methods by their options, and the
// settings of a matrix by their values.
#include "experiments/runner/region.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

#include "experiments/runner/axes.hpp"
#include "experiments/settings/setting.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/numbers.hpp"
#include "renderer/core/toml_table.hpp"

namespace footprint {
namespace {

constexpr std::string_view distance_key = "distance";
constexpr NumberRange factors{0.001, 1000};

std::vector<std::string> region_keys() {
  std::vector<std::string> keys{std::string(distance_key)};
  std::ranges::copy_if(axis_keys(), std::back_inserter(keys), [](const std::string& key) { return key != "scene"; });
  return keys;
}

Axis read_factors(const TomlTable& region) {
  Axis axis{.key = std::string(distance_key)};
  const std::vector<double> values = region.numbers(distance_key, 0, factors).value();
  for (const double value : values) axis.values.push_back(fmt::format("{}", value));
  return axis;
}

// An axis of methods: the one that the file calls `method`, with each combination of its options.
Axis read_readings(const TomlTable& options, const std::string& method, const Experiment& experiment) {
  const std::vector<std::string> texts = texts_of(experiment.run.methods);
  const std::size_t index = at_key(options, method, [&] { return select_method(method, texts); });
  Axis axis{.key = texts[index]};
  for (const std::string& text : times_options(options, method, texts[index])) {
    at_key(options, method, [&] { return parse_methods_with_histories(text, experiment.run.method_folder); });
    axis.values.push_back(text);
  }
  return axis;
}

void check_axes(const TomlTable& region, const std::vector<Axis>& axes) {
  std::size_t settings = 1;
  for (const Axis& axis : axes) {
    settings *= axis.values.size();
    for (auto value = axis.values.begin(); value != axis.values.end(); ++value) {
      if (std::find(axis.values.begin(), value, *value) != value)
        throw region.error_at("", fmt::format("has `{:.80}` twice for {}", *value, axis.key), "give each once");
    }
  }
  if (settings > most_members)
    throw region.error_at("", fmt::format("makes {} settings, {} at most", settings, most_members), "leave values out");
}

// Claims are about figures: what no claim asks for is not measured at every point of the grid.
void measure_less(Experiment& experiment) {
  constexpr std::array<std::string_view, 9> over_times{"time",  "fps",   "build",          "shading",           "total",
                                                       "ratio", "bytes", "equivalent_spp", "supersampling_time"};
  constexpr std::array<std::string_view, 5> over_causes{"representation", "filtering", "filter_error", "method_error",
                                                        "light_error"};
  const auto asks_for = [&](std::span<const std::string_view> functions) {
    return std::ranges::any_of(experiment.claims, [&](const Claim& claim) {
      std::vector<Measure> measures = claim.inequality.left.measures();
      std::ranges::copy(claim.inequality.right.measures(), std::back_inserter(measures));
      return std::ranges::any_of(measures, [&](const Measure& measure) {
        return std::ranges::find(functions, measure.function->name) != functions.end();
      });
    });
  };
  RunSettings& run = experiment.run;
  if (!asks_for(over_times)) {
    run.timing.repeats = 1;
    run.reference.supersampling = {1};
  }
  if (!asks_for(over_causes)) {
    run.reference.by_cause = false;
    run.reference.bound = BoundUse::off;
  }
}

// All distances, and those that claims name.
void scale_distances(Experiment& experiment, double factor) {
  ViewSettings& view = experiment.run.view;
  if (view.zoom.frames > 0) {
    view.zoom.from = view.zoom.from.value() * factor;
    view.zoom.to = view.zoom.to.value() * factor;
  } else {
    view.distances = distances_of(experiment);
    for (double& distance : view.distances) distance *= factor;
  }
  const auto scale = [&](Measure& measure) {
    if (const auto distance = measure.number(Selector::distance))
      measure.selected[Selector::distance] = fmt::format("{}", *distance * factor);
  };
  for (Claim& claim : experiment.claims) claim.inequality.for_each_measure(scale);
}

// `method`, as written, becomes another in the run and in the claims.
void replace_method(Experiment& experiment, const std::string& method, const std::string& by) {
  std::vector<MethodSpec>& methods = experiment.run.methods;
  const std::vector<std::string> texts = texts_of(methods);
  const std::size_t index = select_method(method, texts);
  for (Claim& claim : experiment.claims) {
    claim.inequality.for_each_measure([&](Measure& measure) {
      if (select_method(measure.method, texts) == index) measure.method = by;
    });
  }
  methods[index] = parse_methods_with_histories(by, experiment.run.method_folder).front();
}

Experiment at_place(const Experiment& stated, const Coordinates& place) {
  Experiment experiment = stated;
  const std::vector<std::string> keys = region_keys();
  for (const auto& [key, value] : place) {
    if (key == distance_key) {
      scale_distances(experiment, parse_whole_of<double>(value).value());
    } else if (std::ranges::find(keys, key) != keys.end()) {
      set_value(experiment, key, value);
    } else {
      replace_method(experiment, key, value);
    }
  }
  experiment.coordinates = place;
  return experiment;
}

// A folder's name for a place: methods would make it too long.
std::vector<std::string> folder_names(std::size_t count) {
  std::vector<std::string> names{"stated"};
  for (std::size_t i = 1; i <= count; ++i) names.push_back(fmt::format("setting_{:03}", i));
  return names;
}

}  // namespace

void read_region(const TomlTable& root, Experiment& experiment) {
  std::vector<std::string> keys = region_keys();
  keys.emplace_back("options");
  const auto region = root.table("region", keys);
  if (!region) return;
  if (!experiment.axes.empty()) throw root.error_at("region", "excludes [matrix]", "give one or the other");
  if (experiment.claims.empty()) throw root.error_at("region", "has no claim to judge", "add a [[claim]]");
  if (region->has(distance_key)) experiment.region.push_back(read_factors(*region));
  for (const std::string& key : axis_keys()) {
    if (key != "scene" && region->has(key)) experiment.region.push_back(read_axis(*region, key));
  }
  if (region->has("options")) {
    const std::vector<std::string> methods = region->keys_of("options");
    const TomlTable options = *region->table("options", methods);
    for (const std::string& method : methods) experiment.region.push_back(read_readings(options, method, experiment));
  }
  if (experiment.region.empty())
    throw root.error_at("region", "varies nothing", fmt::format("give one of {}", fmt::join(keys, ", ")));
  check_axes(*region, experiment.region);
}

std::vector<Experiment> settings_of_region(const Experiment& stated) {
  if (stated.region.empty())
    throw Error(ErrorKind::usage, stated.file.string(), "has no [region]",
                "list there what the paper leaves open (docs/reference/experiments.md)");
  Experiment plain = stated;
  plain.region.clear();
  plain.thresholds.clear();
  plain.published.clear();
  plain.figure = {};
  plain.whole = stated.name;
  measure_less(plain);
  std::vector<Experiment> settings{plain};
  for (const Coordinates& place : multiplied_out(stated.region)) settings.push_back(at_place(plain, place));
  const std::vector<std::string> names = folder_names(settings.size() - 1);
  for (std::size_t i = 0; i < settings.size(); ++i) settings[i].name = names[i];
  return settings;
}

RegionReport region_report(const Experiment& stated, std::span<const Results> runs) {
  RegionReport report{.tool = runs.front().tool,
                      .backend = runs.front().backend,
                      .experiment = stated.name,
                      .title = stated.title,
                      .file = stated.file.string(),
                      .quick = stated.quick};
  for (const Axis& axis : stated.region) report.axes.push_back({axis.key, axis.values});
  const std::vector<std::string> names = folder_names(runs.size() - 1);
  for (std::size_t i = 1; i < runs.size(); ++i) report.settings.push_back({names[i], runs[i].coordinates});
  for (const ClaimOutcome& claim : runs.front().experiment.value().claims) {
    RegionClaim& found = report.claims.emplace_back(RegionClaim{.name = claim.name,
                                                                .text = claim.text,
                                                                .inequality = claim.inequality,
                                                                .source = claim.source,
                                                                .stated = claim.outcome});
    const std::size_t index = report.claims.size() - 1;
    for (const Results& run : runs.subspan(1)) found.outcomes.push_back(run.experiment.value().claims[index].outcome);
  }
  return report;
}

}  // namespace footprint
