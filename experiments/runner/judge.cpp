// Compares outcomes with what was expected, decides claims over times again by estimates for GPUs, and bounds the noise
// under each threshold from below.
#include "experiments/runner/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

constexpr double not_estimated = std::numeric_limits<double>::quiet_NaN();

// Milliseconds are nanoseconds per pixel times the pixels that the object covers: an estimate has no fixed costs of a
// frame.
void set_estimated_times(Record& record, const std::string& gpu) {
  const auto cost = std::ranges::find(record.gpu_costs, gpu, &GpuCost::gpu);
  const bool is_known = cost != record.gpu_costs.end() && !cost->failure;
  const double ms_per_ns = 1e-6 * static_cast<double>(record.pixels.object);
  const double ms = is_known ? ms_per_ns * cost->cost_ns : not_estimated;
  record.frame_ms = FrameTime{.median = ms, .minimum = ms, .p90 = ms};
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

ClaimOutcome outcome_of(const Claim& claim, std::span<const Results> runs) {
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
      const ClaimOutcome outcome = outcome_of(claim, estimated);
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
  for (const Record& record : records) {
    Record& own = known.emplace_back();  // without the fields that no threshold here uses
    own.method = record.method;
    own.distance = record.distance;
    own.frame = record.frame;
    own.error = record.error;
    own.other_references = record.other_references;
    own.flicker = record.flicker;
  }
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
  const std::size_t first = measure.function->name.starts_with("flicker") ? 1 : 0;  // the first frame has none
  std::size_t count = 0;
  for (std::size_t m = 0; m < members_.size(); ++m) {
    if (!selects(measure, members_[m].coordinates)) continue;
    for (std::size_t i = first; i < distances_[m].size(); ++i) {
      const bool is_meant = (!measure.distance || distances_[m][i] == *measure.distance) &&
                            (!measure.frame || static_cast<std::size_t>(*measure.frame) == i);
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
                          .published = {},
                          .claims = {},
                          .second_verdicts = second_verdicts(experiment, runs),
                          .thresholds = {},
                          .pictures = {}};
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

}  // namespace footprint
