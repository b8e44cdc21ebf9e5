// See measure.hpp.
#include "experiments/runner/measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>

#include "renderer/core/error.hpp"
#include "renderer/core/suggest.hpp"

namespace footprint {
namespace {

using Figure = std::optional<double>;

struct Function {
  std::string name;
  std::function<Figure(const Record&)> figure;
};

Function of_error(const char* name, double RecordError::*member) {
  return {name, [member](const Record& r) { return r.error ? Figure((*r.error).*member) : Figure(); }};
}

// A bound of the measured curve counts as its end: "<1" as 1, ">64" as 64.
Figure equivalent_count(const Record& record) {
  if (record.equivalent_spp) return record.equivalent_spp;
  const std::string& bound = record.equivalent_bound;
  if (bound.empty() || (bound.front() != '<' && bound.front() != '>')) return std::nullopt;
  double end = 0;
  const auto parsed = std::from_chars(bound.data() + 1, bound.data() + bound.size(), end);
  return parsed.ec == std::errc() ? Figure(end) : Figure();
}

/// What of a build that runs each frame the frame's time has in it.
double build_in_frame(const Record& record) {
  return record.frame_build == "every frame" ? record.frame_build_ms.value_or(0.0) : 0.0;
}

/// A frame with its build, whether or not the timed frames kept theirs.
Figure total_time(const Record& record) {
  return record.frame_ms.median - build_in_frame(record) + record.frame_build_ms.value_or(0.0);
}

const std::vector<Function>& functions() {
  static const std::vector<Function> table{
      of_error("error", &RecordError::normalized_color),
      of_error("relative_rmse", &RecordError::relative_rmse),
      of_error("relmse", &RecordError::relmse),
      of_error("psnr", &RecordError::psnr),
      of_error("energy_bias", &RecordError::energy_bias),
      of_error("representation", &RecordError::representation),
      of_error("filtering", &RecordError::filtering),
      {"noise_floor", [](const Record& r) { return r.error ? r.error->noise_floor : Figure(); }},
      {"equivalent_spp", equivalent_count},
      {"flicker", [](const Record& r) { return r.flicker ? Figure(r.flicker->mean) : Figure(); }},
      {"flicker_p99", [](const Record& r) { return r.flicker ? Figure(r.flicker->p99) : Figure(); }},
      {"time", [](const Record& r) { return Figure(r.frame_ms.median); }},
      {"build", [](const Record& r) { return r.frame_build_ms; }},
      {"shading", [](const Record& r) { return Figure(r.frame_ms.median - build_in_frame(r)); }},
      {"total", total_time},
      {"ratio", [](const Record& r) { return Figure(r.ratio_to_direct.median); }},
      {"fps", [](const Record& r) { return Figure(r.fps); }},
      {"precompute", [](const Record& r) { return r.precompute_cached ? Figure() : Figure(r.precompute_seconds); }},
      {"bytes", [](const Record& r) { return Figure(static_cast<double>(r.precompute_bytes)); }},
      {"bytes_per_texel", [](const Record& r) { return r.precompute_bytes_per_texel; }}};
  return table;
}

struct NdfFunction {
  std::string name;
  double NdfFigures::*figure;
};

const std::array<NdfFunction, 3>& ndf_functions() {
  static const std::array<NdfFunction, 3> table{
      {{"ndf_l2", &NdfFigures::l2}, {"ndf_energy", &NdfFigures::energy}, {"ndf_peak", &NdfFigures::peak}}};
  return table;
}

constexpr const char* supersampling_function = "supersampling_time";
constexpr const char* quantity_function = "quantity";

Measured mean_of(double sum, std::size_t count) {
  const double mean = sum / static_cast<double>(count);
  if (std::isnan(mean)) return {.value = {}, .problem = "the figure is not a number"};
  return {.value = mean, .problem = {}};
}

// The mean over the footprints.
Measured measured_ndf(const Measure& measure, const std::string& method, const Results& results) {
  const auto function = std::ranges::find(ndf_functions(), measure.function, &NdfFunction::name);
  double sum = 0;
  std::size_t count = 0;
  for (const NdfFigures& figures : results.ndf) {
    if (figures.method != method || (measure.footprint && figures.footprint != *measure.footprint)) continue;
    sum += figures.*function->figure;
    ++count;
  }
  return count > 0 ? mean_of(sum, count) : Measured{.value = {}, .problem = "no such footprint was looked into"};
}

// The mean over the distances.
Measured measured_supersampling(const Measure& measure, const Results& results) {
  double sum = 0;
  std::size_t count = 0;
  for (const SupersamplingPoint& point : results.supersampling) {
    if (point.spp != measure.spp || (measure.distance && point.distance != *measure.distance)) continue;
    sum += point.ms;
    ++count;
  }
  return count > 0 ? mean_of(sum, count) : Measured{.value = {}, .problem = "no such count of samples was timed"};
}

Measured measured_quantity(const Measure& measure, const std::string& method, const Results& results) {
  for (const QuantityFigure& figure : results.quantities) {
    if (figure.method == method && figure.name == measure.quantity) return mean_of(figure.value, 1);
  }
  return {.value = {}, .problem = "the run has no such figure"};
}

struct Sample {
  Figure value;
  bool at_noise_floor = false;
};

Sample sample(const Measure& measure, const Function& function, const Record& record) {
  if (!measure.spp) {
    const bool noisy = measure.function == "error" && record.error && record.error->noise_floor &&
                       record.error->normalized_color <= *record.error->noise_floor;
    return {function.figure(record), noisy};
  }
  const auto other = std::ranges::find(record.other_references, *measure.spp, &OtherReference::spp);
  if (other == record.other_references.end()) return {};
  return {other->normalized_color, other->noise_floor && other->normalized_color <= *other->noise_floor};
}

bool matches(const Measure& measure, const std::string& method, const Record& record) {
  return record.method == method && (!measure.distance || record.distance == *measure.distance) &&
         (!measure.frame || record.frame == *measure.frame);
}

std::vector<std::string> methods_of(const Results& results) {
  std::vector<std::string> methods;
  for (const Record& record : results.records) {
    if (std::ranges::find(methods, record.method) == methods.end()) methods.push_back(record.method);
  }
  return methods;
}

}  // namespace

const std::vector<std::string>& measure_functions() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Function& function : functions()) all.push_back(function.name);
    for (const NdfFunction& function : ndf_functions()) all.push_back(function.name);
    all.emplace_back(supersampling_function);
    all.emplace_back(quantity_function);
    return all;
  }();
  return names;
}

bool takes_spp(const std::string& function) { return function == "error" || is_of_supersampling(function); }

bool is_of_supersampling(const std::string& function) { return function == supersampling_function; }

bool is_of_ndf(const std::string& function) {
  return std::ranges::find(ndf_functions(), function, &NdfFunction::name) != ndf_functions().end();
}

bool is_quantity(const std::string& function) { return function == quantity_function; }

std::string measure_text(const Measure& measure) {
  std::string text = fmt::format("{}({}", measure.function, measure.method);
  if (measure.distance) text += fmt::format(", distance={}", *measure.distance);
  if (measure.frame) text += fmt::format(", frame={}", *measure.frame);
  if (measure.footprint) text += fmt::format(", footprint={}", *measure.footprint);
  if (measure.quantity) text += fmt::format(", name={}", *measure.quantity);
  if (measure.spp) text += fmt::format(", spp={}", *measure.spp);
  return text + ")";
}

std::size_t select_method(const std::string& wanted, std::span<const std::string> methods) {
  std::vector<std::size_t> of_name;
  std::vector<std::string> known(methods.begin(), methods.end());
  for (std::size_t i = 0; i < methods.size(); ++i) {
    if (methods[i] == wanted) return i;
    const std::string name = methods[i].substr(0, methods[i].find(':'));
    if (name == wanted) of_name.push_back(i);
    if (std::ranges::find(known, name) == known.end()) known.push_back(name);
  }
  if (of_name.size() == 1) return of_name.front();
  if (of_name.empty()) {
    throw Error(ErrorKind::usage, "", fmt::format("the experiment has no method `{:.80}`", wanted),
                suggestion(wanted, known));
  }
  throw Error(ErrorKind::usage, "", fmt::format("`{}` is {} of the experiment's methods", wanted, of_name.size()),
              "write it with its options, as in the experiment");
}

Measured measured(const Measure& measure, const Results& results) {
  const std::vector<std::string> methods = methods_of(results);
  const std::string& method = methods[select_method(measure.method, methods)];
  if (is_of_ndf(measure.function)) return measured_ndf(measure, method, results);
  if (is_of_supersampling(measure.function)) return measured_supersampling(measure, results);
  if (is_quantity(measure.function)) return measured_quantity(measure, method, results);
  const auto function = std::ranges::find(functions(), measure.function, &Function::name);
  double sum = 0;
  std::size_t count = 0, noisy = 0, matching = 0;
  for (const Record& record : results.records) {
    if (!matches(measure, method, record)) continue;
    ++matching;
    const Sample found = sample(measure, *function, record);
    if (!found.value) continue;
    sum += *found.value;
    ++count;
    noisy += found.at_noise_floor ? 1 : 0;
  }
  if (matching == 0) return {.value = {}, .problem = "the run has no such record"};
  if (count == 0 && measure.function == "precompute") {
    return {.value = {}, .problem = "the bake came from the cache (give --no-cache)"};
  }
  if (count == 0) return {.value = {}, .problem = "no record has this figure"};
  Measured mean = mean_of(sum, count);
  mean.at_noise_floor = noisy == count;
  return mean;
}

}  // namespace footprint
