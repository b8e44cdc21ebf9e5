// Evaluates an experiment's expressions over its results, and compares each outcome with what was expected.
#include "experiments/runner/judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "experiments/runner/estimated_times.hpp"
#include "experiments/runner/functions.hpp"
#include "experiments/runner/noise_guard.hpp"

namespace footprint {
namespace {

void add_figures(const Evaluation& evaluation, std::vector<ClaimFigure>& figures) {
  for (const MeasuredCall& call : evaluation.calls) {
    if (std::ranges::find(figures, call.text, &ClaimFigure::measure) != figures.end()) continue;
    figures.push_back({.measure = call.text, .value = call.value, .at_noise_floor = call.at_noise_floor});
  }
}

ClaimOutcome outcome_of(const Claim& claim, std::span<const Results> runs) {
  const Evaluation left = claim.inequality.left().evaluate(runs);
  const Evaluation right = claim.inequality.right().evaluate(runs);
  ClaimOutcome outcome{.name = claim.name,
                       .text = claim.text,
                       .inequality = claim.inequality.text(),
                       .expect = claim.expect,
                       .outcome = Verdict::undecided,
                       .reason = claim.reason,
                       .problem = left.problem.empty() ? right.problem : left.problem,
                       .left = left.value,
                       .right = right.value,
                       .figures = {},
                       .place = claim.place};
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
  return !claim.inequality.left().evaluate(runs).nodes.empty() ||
         !claim.inequality.right().evaluate(runs).nodes.empty();
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
      verdicts.push_back({.claim = claim.name,
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
    report.published.push_back({.figure = published.figure,
                                .measure = published.measure.text(),
                                .unit = published.unit,
                                .published = published.value,
                                .measured = measured.value,
                                .note = measured.value ? published.note : measured.problem});
  }
  for (const Claim& claim : experiment.claims) report.claims.push_back(outcome_of(claim, runs));
  for (const Threshold& threshold : experiment.thresholds) report.thresholds.push_back(outcome_of(threshold, runs));
  return report;
}

}  // namespace footprint
