// Refuses thresholds that lie within the reference's noise, as soon as a run knows that noise and before it times
// anything.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "experiments/runner/experiment.hpp"
#include "experiments/studies/compare.hpp"

namespace footprint {

/// The measure of a threshold on a single error or flicker, which the reference's noise may decide; none for a
/// threshold on an expression of several.
[[nodiscard]] std::optional<Measure> single_measure(const Threshold& threshold);

/// Of one experiment, or of a matrix. A bound on a single error or flicker that is no higher than what the reference's
/// noise causes of it could be neither held nor missed. Such a bound may be on a mean over distances and members of
/// which some are still to come: noise is never below 0, so that the floors that are known, over the count of all, are
/// what theirs is at least.
class NoiseGuard {
 public:
  /// `judged` has the thresholds, `members` are those that are run: of a matrix some or all, else itself. Keeps the
  /// addresses of both. A quick run is no measurement, and nothing of it is refused. Errors (usage): of their scenes.
  NoiseGuard(const Experiment& judged, std::span<const Experiment> members);

  /// What watches the run of a member. Errors (usage), while it runs: FILE:LINE of the threshold.
  [[nodiscard]] RecordWatch watch(const Experiment& member);

 private:
  void see(std::size_t member, std::span<const Record> records);
  void hold(const Threshold& threshold) const;
  /// The records that a measure will be over.
  [[nodiscard]] std::size_t count_of(const Measure& measure) const;

  const Experiment* judged_;
  std::span<const Experiment> members_;
  std::vector<Results> known_;                  // a member
  std::vector<std::vector<double>> distances_;  // likewise
};

}  // namespace footprint
