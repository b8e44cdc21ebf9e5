// Runs an experiment: the comparison, its figures, and what became of its claims; thresholds within the reference's
// noise are refused as soon as a run knows that noise and before it times anything. Figures are composed of a run's
// pictures as a paper composes its own: rows, columns, crops and insets.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "experiments/runner/experiment.hpp"
#include "experiments/studies/compare.hpp"
#include "renderer/core/run_folder.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// Everything but the pictures. A claim is `undecided` where a figure is missing, where it is over times of a GPU that
/// no run was drawn on, or where that is expected; a threshold without a figure has not passed. `runs` has the results
/// of this experiment, or those of the members of this matrix.
[[nodiscard]] ExperimentReport judge(const Experiment& experiment, std::span<const Results> runs);

/// For one experiment or one matrix. A limit on a single error or flicker that is no higher than what the reference's
/// noise causes of it could be neither passed nor missed. A limit on a mean may include distances and members that are
/// not measured yet. Noise is at least 0, so the sum of the known floors over the count of all is a lower bound.
class NoiseGuard {
 public:
  /// `judged` has the thresholds, `members` are those that are run: of a matrix some or all, else itself. Stores the
  /// addresses of both. A quick run is not a measurement, so it refuses nothing. Errors (usage): of their scenes.
  NoiseGuard(const Experiment& judged, std::span<const Experiment> members);

  /// The watch of a member's run. Errors (usage), while it runs: FILE:LINE of the threshold.
  [[nodiscard]] RecordWatch watch(const Experiment& member);

 private:
  void see(std::size_t member, std::span<const Record> records);
  void check(const Threshold& threshold) const;
  /// The records that a measure will be over.
  [[nodiscard]] std::size_t count_of(const Measure& measure) const;

  const Experiment* judged_;
  std::span<const Experiment> members_;
  std::vector<Results> known_;                  // per member
  std::vector<std::vector<double>> distances_;  // per member
};

/// Shortens the run for a test: a quarter of the size, few samples and texels.
void make_quick(Experiment& experiment);

/// Runs an experiment, judges its claims and writes its images into FOLDER/images.
/// context: as run_compare takes it.
/// Errors: those of run_compare, and of composed figures.
[[nodiscard]] Results run_experiment(const Experiment& experiment, const RunFolder& folder, const Progress& progress,
                                     const CompareContext& context);

/// A part of an experiment that one process can measure alone.
struct WorkUnit {
  const Experiment* experiment;
  std::vector<std::size_t> distances = {};  ///< by index: one, or all of a zoom; empty: the NDFs and quantities
};

/// All parts of an experiment, in order. Errors (usage): of its scene.
[[nodiscard]] std::vector<WorkUnit> work_units(const Experiment& experiment);

/// Measures a part and stores it in `context.finished`.
/// folder: for images until they are stored.
/// Errors: those of run_experiment.
void measure_unit(const WorkUnit& unit, const RunFolder& folder, const Progress& progress,
                  const CompareContext& context);

/// Reads the run's pictures back from `folder` and writes FOLDER/images/figure.png and, where a method is shown,
/// figure_errors.png (the same pictures' errors in false colour over the scale's legend). Returns their paths from the
/// folder; empty for a layout without rows. The run has every frame of the layout (check_against_scenes). Errors
/// (machine): a picture cannot be read or written.
[[nodiscard]] std::vector<std::string> write_figures(const FigureLayout& layout, const Experiment& experiment,
                                                     const Results& results, const RunFolder& folder);

/// The part of a picture that `crop` leaves: whole pixels, one at least.
[[nodiscard]] Image cropped(const Image& picture, const Crop& crop);

/// `picture` with its part `inset` enlarged by whole factors to about `share` of its width, framed, in the lower right
/// corner.
[[nodiscard]] Image with_inset(const Image& picture, const Crop& inset, double share = 0.4);

}  // namespace footprint
