// Runs an experiment: the comparison, its figures, and what became of its claims.
#pragma once

#include <filesystem>
#include <span>

#include "experiments/runner/experiment.hpp"
#include "experiments/studies/compare.hpp"

namespace footprint {

/// Cuts the run short, to see whether it works and how it looks: a quarter of the size, few samples.
void make_quick(Experiment& experiment);

/// Runs it and writes its pictures into FOLDER/images; the results hold its report. `further_times` are those of other
/// processes, as run_compare takes them. Errors: those of run_compare, and of the figures.
[[nodiscard]] Results run_experiment(const Experiment& experiment, std::span<const FrameTimes> further_times,
                                     const std::filesystem::path& folder, const Progress& progress);

}  // namespace footprint
