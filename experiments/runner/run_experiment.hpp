// Runs an experiment: the comparison, its figures, and what became of its claims.
#pragma once

#include <filesystem>
#include <span>

#include "experiments/runner/experiment.hpp"
#include "experiments/studies/compare.hpp"

namespace footprint {

/// What does not stand in the experiment's file.
struct RunSettings {
  SceneLibrary scene_library;
  bool quick = false;  ///< a quarter of the size, few samples: to see whether it runs and how it looks
  int tile = 0;
  std::optional<std::filesystem::path> cache;  ///< where slow precomputes are kept; none: they are not
  gl::ContextRequest context;
};

/// The comparison that an experiment asks for.
[[nodiscard]] CompareSettings compare_settings(const Experiment& experiment, const RunSettings& settings);

/// Runs it and writes its pictures into FOLDER/images; the results hold its report. `further_times` are those of other
/// processes, as run_compare takes them. Errors: those of run_compare, and of the figures.
[[nodiscard]] Results run_experiment(const Experiment& experiment, const RunSettings& settings,
                                     std::span<const FrameTimes> further_times, const std::filesystem::path& folder,
                                     const Progress& progress);

}  // namespace footprint
