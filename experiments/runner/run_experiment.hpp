// Runs an experiment: the comparison, its figures, and what became of its claims.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "experiments/runner/experiment.hpp"
#include "experiments/studies/compare.hpp"

namespace footprint {

/// Shortens the run for a test: a quarter of the size, few samples and texels.
void make_quick(Experiment& experiment);

/// Runs an experiment, judges its claims and writes its images into FOLDER/images.
/// context: as run_compare takes it.
/// Errors: those of run_compare, and of composed figures.
[[nodiscard]] Results run_experiment(const Experiment& experiment, const std::filesystem::path& folder,
                                     const Progress& progress, const CompareContext& context);

/// A part of an experiment that one process can measure alone.
struct WorkUnit {
  std::vector<std::size_t> distances;  ///< by index: one, or all of a zoom; empty: the NDFs and quantities
};

/// All parts of an experiment, in order. Errors (usage): of its scene.
[[nodiscard]] std::vector<WorkUnit> work_units(const Experiment& experiment);

/// Measures a part and stores it in `context.finished`.
/// folder: for images until they are stored.
/// Errors: those of run_experiment.
void measure_unit(const Experiment& experiment, const WorkUnit& unit, const std::filesystem::path& folder,
                  const Progress& progress, const CompareContext& context);

}  // namespace footprint
