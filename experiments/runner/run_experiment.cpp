// Adds NDFs, quantities and composed figures to a comparison's results, compares outcomes with what was expected,
// decides which claims the renderer can decide, and claims over times again by estimates for GPUs, and bounds the noise
// under each threshold from below.
#include "experiments/runner/run_experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "experiments/runner/matrix.hpp"
#include "experiments/settings/setting.hpp"
#include "experiments/studies/finished_work.hpp"
#include "experiments/studies/ndf_inspection.hpp"
#include "experiments/studies/stage.hpp"
#include "methods/registry.hpp"
#include "renderer/bake/baked_method.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/names.hpp"
#include "renderer/gl/context.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "results/report/record_fields.hpp"
#include "results/report/report.hpp"

namespace footprint {

/// The figures of an experiment that are not about images.
struct FurtherFigures {
  std::vector<FootprintNdf> ndf;
  std::vector<QuantityFigure> quantities;
};

template <>
inline constexpr bool is_private_document<FurtherFigures> = true;

namespace {

constexpr double not_estimated = std::numeric_limits<double>::quiet_NaN();

// Milliseconds are nanoseconds per pixel times the pixels that the object covers: an estimate has no fixed costs of a
// frame.
void set_estimated_times(Record& record, const std::string& gpu) {
  const auto cost = std::ranges::find(record.gpu_costs, gpu, &GpuCost::gpu);
  const bool is_known = cost != record.gpu_costs.end() && !cost->failure;
  const double ms_per_ns = 1e-6 * static_cast<double>(record.pixels.object);
  const double ms = is_known ? ms_per_ns * cost->cost_ns : not_estimated;
  record.frame_ms = FrameTime{.median = ms, .min = ms, .p90 = ms};
  record.fps = 1000.0 / ms;
  record.node.clear();  // an estimate does not depend on the host
  if (!record.frame_build_ms) return;
  record.frame_build_ms = is_known ? ms_per_ns * cost->passes_ns : not_estimated;
  record.frame_build = BuildTiming::every_frame;
}

double direct_ms(const std::vector<Record>& records, double distance) {
  const auto direct = std::ranges::find_if(
      records, [&](const Record& record) { return record.method == "direct" && record.distance == distance; });
  return direct == records.end() ? not_estimated : direct->frame_ms.median;
}

// The GPUs that the records have estimates for, in their order.
std::vector<std::string> estimated_gpus(const Results& results) {
  std::vector<std::string> gpus;
  if (results.records.empty()) return gpus;
  for (const GpuCost& cost : results.records.front().gpu_costs) gpus.push_back(cost.gpu);
  return gpus;
}

// Replaces the frame time of each record by its estimated cost times the pixels of the object, and the time of N
// samples by N frames of `direct`. Times without an estimate become NaN. `ratio_to_direct` stays as measured. gpu: of
// estimated_gpus.
Results with_estimated_times(Results results, const std::string& gpu) {
  for (Record& record : results.records) set_estimated_times(record, gpu);
  for (SupersamplingPoint& point : results.supersampling) {
    point.ms = point.spp * direct_ms(results.records, point.distance);
    point.node.clear();
  }
  return results;
}

// The measure of a threshold on a single error or flicker, which the reference's noise may decide; none for a threshold
// on an expression of several.
std::optional<Measure> single_measure(const Threshold& threshold) {
  const std::vector<Measure> measures = threshold.measure.measures();
  if (measures.size() != 1 || measure_text(measures.front()) != threshold.measure.text()) return {};
  return measures.front();
}

void add_figures(const Evaluation& evaluation, std::vector<ClaimFigure>& figures) {
  for (const Measured& call : evaluation.calls) {
    if (std::ranges::find(figures, call.text, &ClaimFigure::measure) != figures.end()) continue;
    figures.push_back({.measure = call.text, .value = *call.value, .at_noise_floor = call.at_noise_floor});
  }
}

// Why times of a renderer do not decide a claim over times of a GPU; empty: they do.
std::string undecidable_on(const std::string& renderer, const std::vector<std::string>& gpu_class) {
  if (gl::is_software_renderer(renderer)) return fmt::format("timed on {}, a software renderer", renderer);
  const auto is_named = [&](const std::string& word) { return renderer.find(word) != std::string::npos; };
  if (std::ranges::any_of(gpu_class, is_named)) return {};
  const std::string timed = fmt::format("timed on {}", renderer.empty() ? "an unknown renderer" : renderer);
  if (gpu_class.empty()) return timed + ", and no GPU is named that decides it";
  return fmt::format("{}, not on a GPU that decides it: {}", timed, fmt::join(gpu_class, ", "));
}

// Why no figure of the runs decides a claim; empty: figures decide it.
std::string undecidable(const Claim& claim, std::span<const Results> runs) {
  if (claim.stated.source != ClaimSource::gpu_time)
    return claim.stated.expect == Verdict::undecided ? claim.stated.reason : "";
  for (const Results& run : runs) {
    if (std::string why = undecidable_on(run.backend.renderer, claim.gpu_class); !why.empty()) return why;
  }
  return {};
}

// The figures of a claim, and the verdict of its inequality, on whatever machine.
ClaimOutcome evaluated(const Claim& claim, std::span<const Results> runs) {
  const Evaluation left = claim.inequality.left.evaluate(runs);
  const Evaluation right = claim.inequality.right.evaluate(runs);
  ClaimOutcome outcome = claim.stated;
  outcome.problem = left.problem.empty() ? right.problem : left.problem;
  outcome.left = left.value;
  outcome.right = right.value;
  add_figures(left, outcome.figures);
  add_figures(right, outcome.figures);
  std::set<std::string> nodes = left.nodes;
  nodes.insert(right.nodes.begin(), right.nodes.end());
  if (outcome.problem.empty()) outcome.problem = mixed_hosts_message(nodes);
  if (outcome.problem.empty() && left.value && right.value) {
    const bool is_true = claim.inequality.is_true(*left.value, *right.value);
    outcome.outcome = is_true ? Verdict::reproduced : Verdict::not_reproduced;
  }
  return outcome;
}

// The outcome of a claim: undecided, with its figures, if they decide nothing here.
ClaimOutcome outcome_of(const Claim& claim, std::span<const Results> runs) {
  ClaimOutcome outcome = evaluated(claim, runs);
  outcome.undecidable = undecidable(claim, runs);
  if (outcome.undecidable.empty()) return outcome;
  outcome.outcome = Verdict::undecided;
  if (outcome.left && outcome.right) outcome.problem.clear();  // several machines decide no less than one
  return outcome;
}

// A limit on one error that is no higher than the noise of the reference can be neither passed nor missed.
ThresholdOutcome outcome_of(const Threshold& threshold, std::span<const Results> runs) {
  Evaluation found = threshold.measure.evaluate(runs);
  ThresholdOutcome outcome{.measure = threshold.measure.text(),
                           .limit = threshold.limit,
                           .measured = found.value,
                           .problem = std::move(found.problem),
                           .place = threshold.place};
  const bool has_floor = single_measure(threshold) && !found.calls.empty();
  const std::optional<double> floor = has_floor ? found.calls.front().noise_floor : std::nullopt;
  if (found.value && floor && threshold.limit <= *floor) {
    outcome.measured.reset();
    outcome.problem =
        fmt::format("the limit is within the reference's noise, {:.3g}: more samples, or a higher limit", *floor);
  }
  return outcome;
}

bool is_over_times(const Claim& claim, std::span<const Results> runs) {
  return !claim.inequality.left.evaluate(runs).nodes.empty() || !claim.inequality.right.evaluate(runs).nodes.empty();
}

// The claims over times, decided again by the estimates for each GPU.
std::vector<SecondVerdict> second_verdicts(const Experiment& experiment, std::span<const Results> runs) {
  std::vector<SecondVerdict> verdicts;
  if (runs.empty()) return verdicts;
  for (const std::string& gpu : estimated_gpus(runs.front())) {
    std::vector<Results> estimated;
    for (const Results& run : runs) estimated.push_back(with_estimated_times(run, gpu));
    for (const Claim& claim : experiment.claims) {
      if (!is_over_times(claim, runs)) continue;
      const ClaimOutcome outcome = evaluated(claim, estimated);
      verdicts.push_back({.claim = outcome.name,
                          .gpu = gpu,
                          .left = outcome.left,
                          .right = outcome.right,
                          .outcome = outcome.outcome,
                          .problem = outcome.problem});
    }
  }
  return verdicts;
}

constexpr int quick_spp = 16;
constexpr int quick_repeats = 1;
constexpr int quick_divisor = 4;
constexpr int quick_texels = 256;   // a side of surfaces that are made: bakes grow with them
constexpr int quick_default = 128;  // pixels per side where the experiment gives no size

// Looks into one footprint, in a folder ndf/NAME of its own.
std::vector<FootprintNdf> inspected(const Experiment& experiment, const NdfSource& source,
                                    const NamedFootprint& footprint, const RunFolder& folder,
                                    const Progress& progress) {
  const std::string subfolder = "ndf/" + footprint.name;
  std::filesystem::create_directories(folder / subfolder / "images");
  const NdfSettings wanted{.run = experiment.run, .footprint = footprint.rect};
  const NdfResults found = inspect_ndf(source, wanted, folder.below(subfolder), progress);
  std::vector<FootprintNdf> figures;
  for (const auto& [method, record] : found.methods) {
    figures.push_back({.footprint = footprint.name,
                       .method = method,
                       .l2 = record.l2,
                       .energy = record.energy,
                       .peak = record.peak,
                       .lobes = record.lobes,
                       .picture = subfolder + "/" + found.pictures.strip});
  }
  return figures;
}

bool has_further_figures(const Experiment& experiment) {
  return !experiment.footprints.empty() || !experiment.quantities.empty();
}

// The inputs of the figures besides the settings.
std::vector<std::string> figure_content(const Experiment& experiment) {
  std::vector<std::string> content;
  for (const auto& [name, rect] : experiment.footprints) {
    const auto& [lower, upper] = rect;
    content.push_back(fmt::format("{} {} {} {} {}", name, lower.x, lower.y, upper.x, upper.y));
  }
  for (const NamedQuantity& quantity : experiment.quantities) {
    content.push_back(fmt::format("{} {} {}", quantity.name, quantity.quantity, quantity.material));
    for (const auto& [name, value] : quantity.parameters) content.push_back(fmt::format("{}={}", name, value));
  }
  return content;
}

const Material& material_of(const NamedQuantity& named, const Scene& scene) {
  std::vector<std::string> names;
  for (const Material& material : scene.materials) {
    if (named.material.empty() || material.name == named.material) return material;
    names.push_back(material.name);
  }
  throw Error(ErrorKind::usage, scene.source, fmt::format("has no material `{:.80}`", named.material),
              suggestion(named.material, names));
}

// The experiment's quantities, each for every method that has it. Errors (usage): of the figure, naming quantity and
// method; a material that the scene does not have.
std::vector<QuantityFigure> measure_quantities(const Experiment& experiment, const Scene& scene,
                                               const Progress& progress) {
  std::vector<QuantityFigure> figures;
  if (experiment.quantities.empty()) return figures;
  ProgressParts parts(progress, static_cast<double>(experiment.quantities.size() * experiment.run.methods.size()));
  for (const NamedQuantity& named : experiment.quantities) {
    for (const MethodSpec& spec : experiment.run.methods) {
      parts.next(1, "")(fmt::format("{} of {}", named.name, spec.text), 0.0);
      const Method& method = find_method(spec);
      const Quantity* const quantity = find_quantity(method, named.quantity);
      if (quantity == nullptr) continue;
      try {
        const Options options = options_of(method, spec);
        const Options parameters(quantity->parameters, named.parameters, "figure " + named.quantity);
        const double value = quantity->measure(material_of(named, scene), options, parameters);
        figures.push_back({.name = named.name, .method = spec.text, .quantity = named.quantity, .value = value});
      } catch (const Error& error) {
        throw error.within(fmt::format("[[quantity]] {} of {}", named.name, spec.text));
      }
    }
  }
  return figures;
}

FurtherFigures measured_figures(const Experiment& experiment, const Scene& scene, const RunFolder& folder,
                                const Progress& progress) {
  FurtherFigures figures;
  ProgressParts parts(progress, static_cast<double>(experiment.footprints.size() + 1));
  for (const NamedFootprint& footprint : experiment.footprints) {
    const NdfSource source = load_ndf_source({.path = experiment.run.scene}, "", experiment.run.scene_library);
    std::ranges::move(
        inspected(experiment, source, footprint, folder, parts.next(1, "footprint " + footprint.name + ": ")),
        std::back_inserter(figures.ndf));
  }
  if (!experiment.quantities.empty()) figures.quantities = measure_quantities(experiment, scene, parts.next(1, ""));
  return figures;
}

// NDFs and quantities, measured or read back. Errors (usage): they are not finished, and must be.
FurtherFigures further_figures(const Experiment& experiment, const RunFolder& folder, const Progress& progress,
                               const FinishedWork* finished) {
  const RunSettings& run = experiment.run;
  const Scene scene = load_scene(run.scene, run.scene_library, run.overrides);
  std::string fingerprint;
  if (finished != nullptr)
    fingerprint = run_fingerprint(finished->maker(), run, scene, scene_content(scene), figure_content(experiment));
  const KeptParts kept(finished, fingerprint, folder);
  if (auto known = kept.find<FurtherFigures>("figures")) return std::move(*known);
  if (finished != nullptr) finished->require_more_allowed(run.scene);
  FurtherFigures figures = measured_figures(experiment, scene, folder, progress);
  kept.store("figures", figures, files_below(folder.path(), "ndf"));
  return figures;
}

std::vector<std::string> ndf_pictures(const Results& results) {
  std::vector<std::string> pictures;
  for (const FootprintNdf& figures : results.ndf) {
    if (pictures.empty() || pictures.back() != figures.picture) pictures.push_back(figures.picture);
  }
  return pictures;
}

}  // namespace

NoiseGuard::NoiseGuard(const Experiment& judged, std::span<const Experiment> members)
    : judged_(&judged), members_(members), known_(members.size()) {
  for (std::size_t i = 0; i < members.size() && !judged.thresholds.empty(); ++i) {
    known_[i].coordinates = members[i].coordinates;
    distances_.push_back(distances_of(members[i]));
  }
}

RecordWatch NoiseGuard::watch(const Experiment& member) {
  if (member.quick || judged_->thresholds.empty()) return {};
  const auto found = std::ranges::find(members_, member.name, &Experiment::name);
  const auto index = static_cast<std::size_t>(found - members_.begin());
  return [this, index](std::span<const Record> records) { see(index, records); };
}

void NoiseGuard::see(std::size_t member, std::span<const Record> records) {
  std::vector<Record>& known = known_[member].records;
  std::erase_if(known, [&](const Record& record) { return record.distance == records.front().distance; });
  known.insert(known.end(), records.begin(), records.end());
  for (const Threshold& threshold : judged_->thresholds) check(threshold);
}

void NoiseGuard::check(const Threshold& threshold) const {
  const std::optional<Measure> measure = single_measure(threshold);
  if (!measure) return;
  const Evaluation found = threshold.measure.evaluate(known_);
  if (found.calls.empty() || !found.calls.front().noise_floor) return;
  const Measured& call = found.calls.front();
  const auto count = static_cast<double>(std::max(count_of(*measure), call.records));
  const double least = *call.noise_floor * static_cast<double>(call.records) / count;
  if (threshold.limit > least) return;
  throw Error(ErrorKind::usage, threshold.place,
              fmt::format("the threshold {} = {:.3g} is within the reference's noise, {:.3g} or more", call.text,
                          threshold.limit, least),
              "take more samples, or a higher limit");
}

std::size_t NoiseGuard::count_of(const Measure& measure) const {
  std::size_t count = 0;
  for (std::size_t m = 0; m < members_.size(); ++m) {
    if (!selects(measure, members_[m].coordinates)) continue;
    for (std::size_t i = measure.function->first_frame; i < distances_[m].size(); ++i) {
      const bool is_meant =
          measure.takes(Selector::distance, distances_[m][i]) && measure.takes(Selector::frame, static_cast<double>(i));
      count += is_meant ? 1 : 0;
    }
  }
  return count;
}

ExperimentReport judge(const Experiment& experiment, std::span<const Results> runs) {
  ExperimentReport report{.name = experiment.full_name(),
                          .title = experiment.title,
                          .description = experiment.description,
                          .file = experiment.file.string(),
                          .second_verdicts = second_verdicts(experiment, runs)};
  for (const PublishedValue& published : experiment.published) {
    const Evaluation measured = published.measure.evaluate(runs);
    PublishedFigure& figure = report.published.emplace_back(published.printed);
    figure.measured = measured.value;
    if (!measured.value) figure.note = measured.problem;
  }
  for (const Claim& claim : experiment.claims) report.claims.push_back(outcome_of(claim, runs));
  for (const Threshold& threshold : experiment.thresholds) report.thresholds.push_back(outcome_of(threshold, runs));
  return report;
}

void make_quick(Experiment& experiment) {
  RunSettings& run = experiment.run;
  experiment.quick = true;
  run.reference.spp = std::min(run.reference.spp, quick_spp);
  run.reference.fixed_spp = true;  // no noise is waited for
  run.timing.repeats = std::min(run.timing.repeats, quick_repeats);
  if (!run.view.quick_size) {
    run.view.quick_size =
        run.view.size ? glm::max(*run.view.size / quick_divisor, glm::ivec2(1)) : glm::ivec2(quick_default);
  }
  run.view.size = run.view.quick_size;
  run.overrides.most_texels = quick_texels;
}

Results run_experiment(const Experiment& experiment, const RunFolder& folder, const Progress& progress,
                       const CompareContext& context) {
  ProgressParts parts(progress, has_further_figures(experiment) ? 6 : 4);
  Results results = run_compare(experiment.run, folder, parts.next(4, ""), context);
  results.coordinates = experiment.coordinates;
  if (has_further_figures(experiment)) {
    FurtherFigures figures = further_figures(experiment, folder, parts.next(2, ""), context.finished);
    results.ndf = std::move(figures.ndf);
    results.quantities = std::move(figures.quantities);
  }
  results.experiment = judge(experiment, std::span(&results, 1));
  results.experiment->quick = experiment.quick;
  folder.attempt("images/figure.png",
                 [&] { results.experiment->pictures = write_figures(experiment.figure, experiment, results, folder); });
  std::ranges::copy(ndf_pictures(results), std::back_inserter(results.experiment->pictures));
  return results;
}

std::vector<WorkUnit> work_units(const Experiment& experiment) {
  const std::size_t count = distances_of(experiment).size();
  std::vector<WorkUnit> units;
  for (std::size_t i = 0; i < count; ++i) {
    if (i == 0 || experiment.run.view.zoom.frames == 0) units.push_back({&experiment});
    units.back().distances.push_back(i);
  }
  if (has_further_figures(experiment)) units.push_back({&experiment});
  return units;
}

void measure_unit(const WorkUnit& unit, const RunFolder& folder, const Progress& progress,
                  const CompareContext& context) {
  if (!unit.distances.empty()) {
    measure_views(unit.experiment->run, unit.distances, folder, progress, context);
    return;
  }
  (void)further_figures(*unit.experiment, folder, progress, context.finished);
}

}  // namespace footprint
