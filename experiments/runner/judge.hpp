// From an experiment and what its run measured to what became of its claims, thresholds and published figures.
#pragma once

#include <span>

#include "experiments/runner/experiment.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// Everything but the pictures. A claim is `undecided` where a figure is missing; a threshold that has no figure is not
/// held. `runs` are that of this experiment, or those of the members of this matrix.
[[nodiscard]] ExperimentReport judge(const Experiment& experiment, std::span<const Results> runs);

}  // namespace footprint
