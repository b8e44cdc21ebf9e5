// Evaluates the claims, thresholds and published figures of an experiment over the results of its run.
#pragma once

#include <span>

#include "experiments/runner/experiment.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// Everything but the pictures. A claim is `undecided` where a figure is missing; a threshold without a figure has
/// not passed. `runs` has the results of this experiment, or those of the members of this matrix.
[[nodiscard]] ExperimentReport judge(const Experiment& experiment, std::span<const Results> runs);

}  // namespace footprint
