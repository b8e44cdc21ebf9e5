// The functions of expressions: those of the figures of records (figure_table.hpp), and a table of others. For each the
// selectors that it takes, what the experiment must have, and its figure of a run.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <ranges>

#include "experiments/runner/experiment.hpp"
#include "experiments/runner/matrix.hpp"
#include "experiments/settings/setting.hpp"
#include "experiments/studies/stage.hpp"
#include "experiments/studies/view_path.hpp"
#include "methods/registry.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/names.hpp"
#include "results/report/figure_table.hpp"
#include "results/report/figures.hpp"

namespace footprint {
namespace {

[[noreturn]] void refuse(const Measure& measure, const std::string& message, const std::string& hint) {
  throw Error(ErrorKind::usage, measure_text(measure), message, hint);
}

template <typename Values, typename Value>
bool has(const Values& values, const Value& value) {
  return std::ranges::find(values, value) != std::ranges::end(values);
}

// ---- needs

void nothing(const Measure& /*measure*/, const Experiment& /*experiment*/) {}

void its_reference(const Measure& measure, const Experiment& experiment) {
  const std::string* const spp = measure.word(Selector::spp);
  if (spp == nullptr || has(experiment.run.reference.other_spp, *measure.number(Selector::spp))) return;
  refuse(measure, fmt::format("other_spp of [reference] does not have {}", *spp), "add it there, or leave spp out");
}

void a_timed_count(const Measure& measure, const Experiment& experiment) {
  const std::string* const spp = measure.word(Selector::spp);
  if (spp == nullptr) refuse(measure, "does not say of how many samples", "add spp=SAMPLES");
  if (has(experiment.run.reference.supersampling, *measure.number(Selector::spp))) return;
  refuse(measure, fmt::format("no {} samples are timed", *spp),
         fmt::format("timed are [{}]: see supersampling of [reference]",
                     fmt::join(experiment.run.reference.supersampling, ", ")));
}

void a_zoom(const Measure& measure, const Experiment& experiment) {
  if (experiment.run.view.zoom.frames > 0) return;
  refuse(measure, "flicker is measured between frames of a zoom", "give [zoom] from, to and frames");
}

void a_footprint(const Measure& measure, const Experiment& experiment) {
  if (experiment.footprints.empty()) {
    refuse(measure, "no footprint is looked into", "add [[ndf]] with a name and a footprint");
  }
  const std::string* const name = measure.word(Selector::footprint);
  if (name == nullptr) return;
  const auto found = std::ranges::find(experiment.footprints, *name, &NamedFootprint::name);
  if (found != experiment.footprints.end()) return;
  refuse(measure, fmt::format("`{:.80}` is not a footprint", *name), "use the name of one of [[ndf]]");
}

void a_gpu(const Measure& measure, const Experiment& experiment) {
  const std::vector<std::string>& gpus = experiment.run.gpus;
  if (gpus.empty()) refuse(measure, "no GPU's cost is estimated", "add gpu = [\"Steam Deck\"] to [experiment]");
  const std::string* const gpu = measure.word(Selector::gpu);
  if (gpu != nullptr && !has(gpus, *gpu))
    refuse(measure, fmt::format("the experiment has no GPU `{:.80}`", *gpu), suggestion(*gpu, gpus));
  if (gpu == nullptr && gpus.size() > 1)
    refuse(measure, "does not say on which GPU", fmt::format("add gpu= and one of {}", fmt::join(gpus, ", ")));
}

void a_quantity(const Measure& measure, const Experiment& experiment) {
  const std::string* const name = measure.word(Selector::name);
  if (name == nullptr) refuse(measure, "does not say which", "add name=NAME, of one of [[quantity]]");
  const auto named = std::ranges::find(experiment.quantities, *name, &NamedQuantity::name);
  if (named == experiment.quantities.end()) {
    refuse(measure, fmt::format("`{:.80}` is not a quantity", *name), "use the name of one of [[quantity]]");
  }
  const MethodSpec& method = experiment.run.methods[select_method(measure.method, texts_of(experiment.run.methods))];
  if (find_quantity(find_method(method), named->quantity) != nullptr) return;
  refuse(measure, fmt::format("{} has no figure `{}`", method.name, named->quantity), "name a method that has it");
}

// ---- figures

using Number = std::optional<double>;
using Samples = decltype(FigureFunction::samples);

// Whether a measure of a method is over a record, or over another thing that was measured.
bool is_over(const Measure& measure, const std::string& method, const Record& record) {
  return record.method == method && measure.takes(Selector::distance, record.distance) &&
         measure.takes(Selector::frame, record.frame);
}

bool is_over(const Measure& measure, const std::string& method, const FootprintNdf& figures) {
  return figures.method == method && measure.takes(Selector::footprint, figures.footprint);
}

bool is_over(const Measure& measure, const std::string& method, const QuantityFigure& figure) {
  return figure.method == method && measure.takes(Selector::name, figure.name);
}

bool is_over(const Measure& measure, const std::string& /*method*/, const SupersamplingPoint& point) {
  return measure.number(Selector::spp) == point.spp && measure.takes(Selector::distance, point.distance);
}

// A sample of each thing of a kind that the measure is over.
// sample_of: makes it of the measure and the thing, or its value of the thing.
template <class Thing, class SampleOf>
Samples over(std::vector<Thing> Results::*things, SampleOf sample_of) {
  return [=](const Measure& measure, const std::string& method, const Results& run) {
    std::vector<Sample> samples;
    for (const Thing& thing : run.*things) {
      if (!is_over(measure, method, thing)) continue;
      if constexpr (std::is_invocable_v<SampleOf, const Measure&, const Thing&>) {
        samples.push_back(sample_of(measure, thing));
      } else {
        samples.push_back({.value = std::invoke(sample_of, thing)});
      }
    }
    return samples;
  };
}

Samples over_records(auto sample_of) { return over(&Results::records, sample_of); }

Sample sample_with_floor(const Number& value, const Number& floor) {
  return {.value = value, .at_noise_floor = value && floor && *value <= *floor, .noise_floor = floor};
}

// Against the reference of `spp` samples.
Sample sample_of_other(double spp, const Record& record) {
  const auto other = std::ranges::find(record.other_references, spp, &OtherReference::spp);
  if (other == record.other_references.end()) return {};
  return sample_with_floor(other->normalized_color, other->noise_floor);
}

Samples samples_of(const Figure& figure) {
  return over_records([&figure](const Measure& measure, const Record& record) {
    if (const Number spp = measure.number(Selector::spp)) return sample_of_other(*spp, record);
    Sample sample = sample_with_floor(figure.of(record), figure.noise == nullptr ? std::nullopt : figure.noise(record));
    if (figure.is_of_machine) sample.node = record.node;
    return sample;
  });
}

// A figure of the estimate on a GPU.
template <class Value>
Samples over_gpu(Value GpuCost::*member) {
  return over_records([member](const Measure& measure, const Record& record) {
    for (const GpuCost& cost : record.gpu_costs) {
      if (!measure.takes(Selector::gpu, cost.gpu)) continue;
      if (cost.failure) return Sample{.absent = *cost.failure};
      return Sample{.value = static_cast<double>(cost.*member)};
    }
    return Sample{};
  });
}

Sample supersampling_sample(const Measure& /*measure*/, const SupersamplingPoint& point) {
  return {.value = point.ms, .node = point.node};
}

// The function of a figure of records.
FigureFunction function_of(const Figure& figure) {
  using enum Selector;
  FigureFunction function{.name = figure.call.name,
                          .selectors = {distance, frame, scene, size, filter, seed},
                          .needs = nothing,
                          .samples = samples_of(figure),
                          .absent = figure.call.absent,
                          .alias = figure.key};
  if (figure.call.needs == FigureNeeds::other_reference) {
    function.selectors.insert(function.selectors.begin() + 2, spp);
    function.needs = its_reference;
  } else if (figure.call.needs == FigureNeeds::frame_before) {
    function.needs = a_zoom;
    function.first_frame = 1;
  }
  return function;
}

// The functions of other things than records.
std::vector<FigureFunction> function_table() {
  using enum Selector;
  const std::vector<Selector> on_gpu{distance, frame, scene, size, filter, seed, gpu};
  const std::vector<Selector> of_ndf{footprint, scene, size, seed};
  constexpr const char *no_estimate = "no record has an estimate for that GPU",
                       *no_footprint = "no such footprint was looked into";
  return {{"supersampling_time",
           {distance, spp, scene, size, filter, seed},
           a_timed_count,
           over(&Results::supersampling, supersampling_sample),
           "",
           "no such count of samples was timed"},
          {"gpu_cost", on_gpu, a_gpu, over_gpu(&GpuCost::cost_ns), no_estimate},
          {"gpu_instructions", on_gpu, a_gpu, over_gpu(&GpuCost::instructions), no_estimate},
          {"gpu_vertex_instructions", on_gpu, a_gpu, over_gpu(&GpuCost::vertex_instructions), no_estimate},
          {"gpu_texture_reads", on_gpu, a_gpu, over_gpu(&GpuCost::texture_reads), no_estimate},
          {"ndf_l2", of_ndf, a_footprint, over(&Results::ndf, &FootprintNdf::l2), "", no_footprint},
          {"ndf_energy", of_ndf, a_footprint, over(&Results::ndf, &FootprintNdf::energy), "", no_footprint},
          {"ndf_peak", of_ndf, a_footprint, over(&Results::ndf, &FootprintNdf::peak), "", no_footprint},
          {"quantity",
           {name, scene, size, filter, seed},
           a_quantity,
           over(&Results::quantities, &QuantityFigure::value),
           "",
           "the run has no such figure"}};
}

std::vector<FigureFunction> every_function() {
  std::vector<FigureFunction> table;
  for (const Figure& figure : record_figures()) {
    if (!figure.call.name.empty()) table.push_back(function_of(figure));
  }
  std::ranges::move(function_table(), std::back_inserter(table));
  return table;
}

// The mean over the samples; those without a value do not count.
Measured mean_of(const Measure& measure, std::span<const Sample> samples) {
  Measured mean;
  mean.text = measure_text(measure);
  mean.problem = samples.empty() ? measure.function->none : measure.function->absent;
  double sum = 0, floors = 0;  // floors: not a number if one is missing
  std::size_t noisy = 0;
  for (const Sample& sample : samples) {
    if (!sample.value) {
      if (!sample.absent.empty()) mean.problem = sample.absent;
      continue;
    }
    ++mean.records;
    sum += *sample.value;
    floors += sample.noise_floor.value_or(NAN);
    noisy += sample.at_noise_floor ? 1 : 0;
    if (!sample.node.empty()) mean.nodes.insert(sample.node);
  }
  if (mean.records == 0) return mean;
  mean.at_noise_floor = noisy == mean.records;
  if (!std::isnan(floors)) mean.noise_floor = floors / static_cast<double>(mean.records);
  mean.problem = std::isnan(sum) ? "the figure is not a number" : "";
  if (!std::isnan(sum)) mean.value = sum / static_cast<double>(mean.records);
  return mean;
}

// Every value that members are chosen by must be on an axis of the matrix.
void check_slice(const Measure& measure, const Experiment& experiment) {
  for (const Selector selector : axis_selectors) {
    const std::string* const value = measure.word(selector);
    if (value == nullptr) continue;
    const std::string_view key = selector_name(selector);
    const auto axis = std::ranges::find(experiment.axes, key, &Axis::key);
    if (axis == experiment.axes.end())
      refuse(measure, fmt::format("no matrix varies `{}` here", key), fmt::format("leave {}={} out", key, *value));
    if (!has(axis->values, *value))
      refuse(measure, fmt::format("the matrix has no {} `{:.80}`", key, *value), suggestion(*value, axis->values));
  }
}

}  // namespace

std::string mixed_hosts_message(const std::set<std::string>& nodes) {
  if (nodes.size() < 2) return {};
  return fmt::format("its times were taken on {} machines ({}): compare ratios to direct", nodes.size(),
                     fmt::join(nodes, ", "));
}

std::span<const FigureFunction> figure_functions() {
  static const std::vector<FigureFunction> table = every_function();
  return table;
}

void check_measure(const Measure& measure, const Experiment& experiment) {
  (void)select_method(measure.method, texts_of(experiment.run.methods));
  check_slice(measure, experiment);
  measure.function->needs(measure, experiment);
  const std::vector<double> distances = given_distances(experiment.run.view);
  if (distances.empty()) return;  // those of scenes that are not loaded yet
  check_distance(measure, distances, distances.size());
}

void check_distance(const Measure& measure, const std::vector<double>& distances, std::size_t frames) {
  if (measure.number(Selector::frame).value_or(-1) >= static_cast<double>(frames))
    refuse(measure, "no such frame", fmt::format("frames are 0 to {}", frames - 1));
  const std::optional<double> distance = measure.number(Selector::distance);
  if (distance && !has(distances, *distance))
    refuse(measure, "the experiment has no such distance", fmt::format("it has {}", fmt::join(distances, ", ")));
}

Measured measured(const Measure& measure, std::span<const Results> runs) {
  const std::vector<std::string> methods =
      methods_in_order(runs | std::views::transform(&Results::records) | std::views::join);
  const std::string& method = methods[select_method(measure.method, methods)];
  std::vector<Sample> samples;
  for (const Results& run : runs) {
    if (selects(measure, run.coordinates))
      std::ranges::move(measure.function->samples(measure, method, run), std::back_inserter(samples));
  }
  return mean_of(measure, samples);
}

}  // namespace footprint
