// From an experiment and what its run measured to what became of its claims, thresholds and published figures.
#pragma once

#include "experiments/runner/experiment.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// Everything but the pictures. A claim is `undecided` where a figure is missing; a threshold that has no figure is not
/// held. `results` are of this experiment.
[[nodiscard]] ExperimentReport judge(const Experiment& experiment, const Results& results);

}  // namespace footprint
