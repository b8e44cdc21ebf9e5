// Runs an experiment: the comparison, its figures, and what became of its claims.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "experiments/runner/experiment.hpp"
#include "experiments/studies/compare.hpp"

namespace footprint {

/// Cuts the run short, to see whether it works and how it looks: a quarter of the size, few samples and texels.
void make_quick(Experiment& experiment);

/// Runs it and writes its pictures into FOLDER/images; the results hold its report. `further_times` are those of other
/// processes, as run_compare takes them. What `kept` has is not done again, and what is done is kept there;
/// `watch` is as run_compare takes it.
/// Errors: those of run_compare, and of the figures.
[[nodiscard]] Results run_experiment(const Experiment& experiment, const FurtherTimes& further_times,
                                     const std::filesystem::path& folder, const Progress& progress,
                                     const KeptWork* kept, const RecordWatch& watch);

/// What of an experiment one process can do by itself.
struct WorkUnit {
  std::vector<std::size_t> distances;  ///< by index: one, or all of a zoom; none: its NDFs and quantities
};

/// All that an experiment is made of, in order. Errors (usage): of its scene.
[[nodiscard]] std::vector<WorkUnit> work_units(const Experiment& experiment);

/// Does one of them and keeps it; FOLDER is for pictures on their way. Errors: as of run_experiment.
void measure_unit(const Experiment& experiment, const WorkUnit& unit, const FurtherTimes& further_times,
                  const std::filesystem::path& folder, const Progress& progress, const KeptWork& kept,
                  const RecordWatch& watch);

}  // namespace footprint
