// Evaluates each threshold over what is known of a run so far.
#include "experiments/runner/noise_guard.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/runner/functions.hpp"
#include "renderer/core/error.hpp"

namespace footprint {

std::optional<Measure> single_measure(const Threshold& threshold) {
  const std::vector<Measure> measures = threshold.measure.measures();
  if (measures.size() != 1 || measure_text(measures.front()) != threshold.measure.text()) return {};
  return measures.front();
}

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
    Record& own = known.emplace_back();  // without what no threshold here asks for
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
  const MeasuredCall& call = found.calls.front();
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

}  // namespace footprint
