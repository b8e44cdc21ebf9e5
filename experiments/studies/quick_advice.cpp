// Reads the maps on the CPU: no context is made.
#include "experiments/studies/quick_advice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "methods/registry.hpp"
#include "renderer/bake/map_statistics.hpp"
#include "renderer/bake/material_maps.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/memory.hpp"
#include "results/report/figures.hpp"
#include "results/report/record_fields.hpp"

namespace footprint {

namespace {

constexpr double least_error = 1e-6;  // as in the fit

template <class Values>
auto by_footprint(Values& values, const std::string& footprint) {
  return std::ranges::find_if(values, [&](const auto& v) { return v.footprint == footprint; });
}

// The values of all options, so that `tan_gmm` is `tan_gmm:n=4`.
Options options_of(const MethodSpec& spec) { return {find_method(spec).info.options, spec.options, spec.name}; }

const QuickMethod* method_of(const QuickModel& model, const MethodSpec& wanted) {
  for (const QuickMethod& method : model.methods) {
    const MethodSpec spec = parse_methods(method.method).front();
    if (spec.name == wanted.name && options_of(spec).all() == options_of(wanted).all()) return &method;
  }
  return nullptr;
}

// GGX's alpha per texel of the normal map, or its mean where the maps do not match.
Image alphas_of(const Material& material, const Image& normals) {
  Image alphas = roughness_map_of(material);
  for (float& value : alphas.texels) value = std::max(value * value, static_cast<float>(smallest_alpha));
  if (alphas.width == normals.width && alphas.height == normals.height) return alphas;
  return {1, 1, 1, static_cast<float>(mean_of(alphas))};
}

// The logarithms for each level of the model.
std::vector<std::vector<double>> inputs_of(const Material& material, const QuickModel& model) {
  const Image normals = normal_map_of(material), alphas = alphas_of(material, normals);
  std::vector<std::vector<double>> inputs;
  for (const int texels : model.texels_per_pixel) {
    inputs.push_back({std::log(mean_of(alphas))});
    for (const double error : lobe_errors(normals, alphas, std::bit_width(static_cast<unsigned>(texels)) - 1))
      inputs.back().push_back(std::log(std::max(error, least_error)));
  }
  return inputs;
}

// Errors that differ by `factor` differ by three standard errors, as choose() takes it.
double noise_for(double error, double factor) {
  return error * (factor - 1.0) / (3.0 * std::sqrt(1.0 + factor * factor));
}

std::optional<Candidate> candidate_of(const QuickAdvice& advice, const QuickMethod& method,
                                      const std::string& footprint, const std::vector<std::vector<double>>& inputs,
                                      double texels) {
  const auto filter = by_footprint(method.filters, footprint);
  if (filter == method.filters.end()) return {};
  const auto cost = filter->costs.find(advice.limits.gpu);
  if (cost == filter->costs.end()) return {};
  Candidate candidate;
  candidate.method = method.method;
  candidate.footprint = footprint;
  for (std::size_t level = 0; level < inputs.size(); ++level) {
    candidate.errors.push_back(quick_prediction(filter->weights, level, inputs[level]));
    candidate.error += candidate.errors.back() / static_cast<double>(inputs.size());
  }
  candidate.worst = std::ranges::max(candidate.errors);
  candidate.noise = noise_for(candidate.error, by_footprint(advice.model.calibration, footprint)->order_factor);
  candidate.cost = {.median = cost->second, .low = cost->second, .high = cost->second};
  candidate.bytes = static_cast<std::uint64_t>(method.bytes_per_texel * texels);
  return candidate;
}

// What the logarithms of a level are of.
constexpr std::array<std::string_view, 1 + std::tuple_size_v<LobeErrors>> input_names{
    "mean alpha", "error of a texel's own lobe", "error of the mean normal's lobe", "error of the widened lobe",
    "error of the stretched lobe"};

// "mean alpha 0.62 at 2 texels per pixel, where the model knows 0.1 to 0.4" for each input beyond its range; by a
// hundredth more, since both are rounded.
std::vector<std::string> beyond_domain(const std::vector<std::vector<double>>& inputs, const QuickModel& model) {
  std::vector<std::string> found;
  for (std::size_t i = 0; i < input_names.size(); ++i) {
    for (std::size_t level = 0; level < model.domain.size(); ++level) {
      const auto& [least, most] = model.domain[level][i];
      const double value = inputs[level][i];
      if (value >= least - 0.01 && value <= most + 0.01) continue;
      found.push_back(fmt::format("{} {:.2g} at {} texels per pixel, where the model knows {:.2g} to {:.2g}",
                                  input_names[i], std::exp(value), model.texels_per_pixel[level], std::exp(least),
                                  std::exp(most)));
      break;  // one level says it
    }
  }
  return found;
}

// Predictions that differ by more than this are in an order to trust: two thirds of the predicted ratios are right to
// within `order_factor`, which is one standard deviation of their logarithms if these are normal, and this is two.
double sure_factor(const QuickCalibration& own) { return own.order_factor * own.order_factor; }

// Whether `direct` under the filter of the choice may be as accurate.
bool is_direct_as_likely(const MaterialAdvice& own, const QuickModel& model) {
  const Candidate& chosen = own.candidates[own.choice.chosen.value()];
  const auto direct = std::ranges::find_if(own.candidates, [&](const Candidate& other) {
    return other.method == "direct" && other.footprint == chosen.footprint;
  });
  if (direct == own.candidates.end() || chosen.method == "direct") return false;
  return direct->error < chosen.error * sure_factor(*by_footprint(model.calibration, chosen.footprint));
}

void add_doubts(MaterialAdvice& own, const std::vector<std::vector<double>>& inputs, const QuickModel& model) {
  if (const auto beyond = beyond_domain(inputs, model); !beyond.empty())
    own.words.push_back(fmt::format("This map is outside what the model was fitted on: {}. Measure it without --quick.",
                                    fmt::join(beyond, "; ")));
  if (own.choice.chosen && is_direct_as_likely(own, model))
    own.words.emplace_back("No filter (`direct`) may be as accurate: the model is too rough to decide.");
}

MaterialAdvice advice_of(const Material& material, const QuickAdvice& advice, const QuickQuestion& question,
                         const std::vector<const QuickMethod*>& methods) {
  const auto inputs = inputs_of(material, advice.model);
  MaterialAdvice own;
  own.material = material.name;
  own.distances.assign(advice.model.texels_per_pixel.begin(), advice.model.texels_per_pixel.end());
  const auto texels = static_cast<double>(material.normal_map->image.texel_count());
  for (const std::string& footprint : question.filters) {
    for (const QuickMethod* method : methods) {
      if (auto candidate = candidate_of(advice, *method, footprint, inputs, texels))
        own.candidates.push_back(std::move(*candidate));
    }
  }
  std::ranges::stable_sort(own.candidates, {}, [](const Candidate& c) { return c.cost.median; });
  own.choice = choose(own.candidates, advice.limits);
  own.words = advice_sentences(own, advice.limits);
  add_doubts(own, inputs, advice.model);
  return own;
}

void require_gpu(const QuickModel& model, const std::string& gpu) {
  const std::map<std::string, double>& costs = model.methods.front().filters.front().costs;
  if (costs.contains(gpu)) return;
  std::vector<std::string> names;
  for (const auto& [name, cost] : costs) names.push_back(name);
  throw Error(ErrorKind::usage, "--max-cost", fmt::format("the model has no costs on `{}`", gpu),
              fmt::format("give R@GPU with one of {}", fmt::join(names, ", ")));
}

std::string table_of(const MaterialAdvice& material, const std::string& gpu) {
  std::string text = fmt::format("  {:13} {:34}", "footprint", "method; texels per pixel:");
  for (const double texels : material.distances) text += fmt::format(" {:>7.0f}", texels);
  text += fmt::format(" {:>7} {:>10} {:>9}\n", "mean", "cost", "bytes");
  for (const Candidate& candidate : material.candidates) {
    text += fmt::format("  {:13} {:34}", candidate.footprint, candidate.method);
    for (const double error : candidate.errors) text += fmt::format(" {:>7.4f}", error);
    text += fmt::format(" {:>7.4f} {:>10.2f} {:>9}\n", candidate.error, candidate.cost.median,
                        readable_bytes(candidate.bytes));
  }
  return text + fmt::format("  cost: estimated on {}, over direct under trilinear\n", gpu);
}

std::string trust_of(const QuickCalibration& own) {
  return fmt::format(
      "{}: of {} other scenes, half of the errors are within a factor of {:.2f}, and 80% between {:.2f} and {:.2f} "
      "times the prediction; {:.0f}% of pairs are in the right order, {:.0f}% of first places within 10% of the best\n",
      own.footprint, own.scenes, own.median_factor, own.interval_80[0], own.interval_80[1], 100.0 * own.order_right,
      100.0 * own.choice_right);
}

// Whether each filter has its weights and its calibration, and there is one.
bool is_whole(const QuickModel& model) {
  const std::size_t weights = model.texels_per_pixel.size() + 1 + std::tuple_size_v<LobeErrors>;
  for (const QuickMethod& method : model.methods) {
    const auto is_known = [&](const QuickFilter& filter) {
      return filter.weights.size() == weights &&
             by_footprint(model.calibration, filter.footprint) != model.calibration.end();
    };
    if (method.filters.empty() || !std::ranges::all_of(method.filters, is_known)) return false;
  }
  const auto is_level = [](const auto& level) { return level.size() == input_names.size(); };
  return !model.methods.empty() && model.domain.size() == model.texels_per_pixel.size() &&
         std::ranges::all_of(model.domain, is_level);
}

// The trust that both calibrations leave.
QuickCalibration worse_of(QuickCalibration own, const QuickCalibration& other) {
  own.scenes += other.scenes;
  own.median_factor = std::max(own.median_factor, other.median_factor);
  own.interval_80 = {std::min(own.interval_80[0], other.interval_80[0]),
                     std::max(own.interval_80[1], other.interval_80[1])};
  own.order_factor = std::max(own.order_factor, other.order_factor);
  own.order_right = std::min(own.order_right, other.order_right);
  own.choice_right = std::min(own.choice_right, other.choice_right);
  return own;
}

void join_calibrations(QuickModel& model) {
  for (QuickCalibration& own : model.calibration) {
    if (const auto other = by_footprint(model.surfaces, own.footprint); other != model.surfaces.end())
      own = worse_of(own, *other);
  }
}

}  // namespace

QuickModel read_quick_model(const std::filesystem::path& file) {
  const auto json = nlohmann::ordered_json::parse(std::ifstream(file), nullptr, false);
  try {
    auto model = from_json_value<QuickModel>(json);
    if (json.at("schema") == "footprint-quick-model/1" && is_whole(model)) {
      join_calibrations(model);
      return model;
    }
  } catch (const nlohmann::json::exception&) {  // as of a model that is not whole
  }
  throw Error(ErrorKind::machine, file.string(), "is not a whole footprint-quick-model/1", "install the program again");
}

double quick_prediction(const std::vector<double>& weights, std::size_t level, const std::vector<double>& log_inputs) {
  double sum = weights.at(level);
  const std::size_t levels = weights.size() - log_inputs.size();
  for (std::size_t i = 0; i < log_inputs.size(); ++i) sum += weights[levels + i] * log_inputs[i];
  return std::exp(sum);
}

QuickAdvice quick_advice(const Scene& scene, QuickModel model, const QuickQuestion& question) {
  require_gpu(model, question.limits.gpu);
  QuickAdvice advice{.scene = scene.name, .model = std::move(model), .limits = question.limits};
  std::vector<const QuickMethod*> methods;
  for (const MethodSpec& wanted : question.methods) {
    if (const QuickMethod* method = method_of(advice.model, wanted)) {
      methods.push_back(method);
    } else {
      advice.left_out.push_back({.method = wanted.text, .reason = "the model has no figures of it"});
    }
  }
  for (const std::string& filter : question.filters) {
    if (by_footprint(advice.model.calibration, filter) == advice.model.calibration.end())
      advice.left_out.push_back({.method = "every method under " + filter, .reason = "the model has no figures of it"});
  }
  for (const Material& material : scene.materials) {
    if (!material.normal_map) continue;
    advice.materials.push_back(advice_of(material, advice, question, methods));
    if (advice.materials.back().candidates.empty())
      throw Error(ErrorKind::usage, "--quick", "the model has none of these methods and footprint filters",
                  "measure them without --quick");
  }
  if (advice.materials.empty())
    throw Error(ErrorKind::usage, scene.source, "no material has a normal map", "there is nothing to filter");
  return advice;
}

std::string quick_advice_text(const QuickAdvice& advice) {
  std::string text =
      fmt::format("{}, {}: predicted from the statistics of each normal map, for a flat GGX surface under two lights\n",
                  advice.scene, limits_text(advice.limits));
  for (const auto& [method, reason] : advice.left_out) text += fmt::format("left out {}: {}\n", method, reason);
  for (const MaterialAdvice& material : advice.materials) {
    text += fmt::format("\n{}\n", material.material);
    for (const std::string& sentence : material.words) text += "  " + sentence + "\n";
    text += "\n" + table_of(material, advice.limits.gpu);
  }
  text += fmt::format("\nThe model was fitted on {} scenes of maps that others made. Its noise, under\n",
                      advice.model.scenes);
  for (const QuickCalibration& own : advice.model.calibration) text += trust_of(own);
  return text + "`footprint recommend` without --quick measures.\n";
}

std::string quick_advice_json(const QuickAdvice& advice) {
  nlohmann::ordered_json json{{"schema", "footprint-quick/1"},
                              {"scene", advice.scene},
                              {"limits", to_json_value(advice.limits)},
                              {"texels_per_pixel", advice.model.texels_per_pixel},
                              {"calibration", to_json_value(advice.model.calibration)},
                              {"left_out", to_json_value(advice.left_out)},
                              {"materials", nlohmann::ordered_json::array()}};
  for (const MaterialAdvice& own : advice.materials)
    json["materials"].push_back({{"material", own.material},
                                 {"chosen", to_json_value(own.choice.chosen)},
                                 {"nearest", to_json_value(own.choice.nearest)},
                                 {"words", own.words},
                                 {"candidates", to_json_value(own.candidates)}});
  return json_text(json, 2) + "\n";
}

}  // namespace footprint
