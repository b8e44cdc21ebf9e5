// Figures of earlier runs that later ones are held against: a file that is written when somebody asks for it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "results/report/check_outcomes.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// Figures by their names ("error", "shading", "flicker", "bytes"), by record ("toksvig at 2"), by experiment.
using BaselineFigures = std::map<std::string, std::map<std::string, std::map<std::string, double>>>;

/// A baseline: figures, and how far errors and flicker may lie from them.
struct Baseline {
  double tolerance =
      1e-4;  ///< normalised colour error; pictures are the same to about 1e-5 between kinds of processors
  BaselineFigures figures;
};

/// Of each record of a run of an experiment what a baseline holds: errors, flicker, and the bytes that it baked. No
/// times.
[[nodiscard]] BaselineFigures baseline_figures(const Results& results);

/// The document of format `footprint-baseline/1`.
[[nodiscard]] std::string baseline_json(const Baseline& baseline);

/// Reads it. Errors (usage): not such a document; `place` is the file.
[[nodiscard]] Baseline parse_baseline(const std::string& text, const std::string& place);

/// One outcome for each record of the experiments in `now`: a figure that lies further from the baseline's than its
/// tolerance (bytes: at all), one that only one of both has, and a record that only one of both has fall short.
/// Experiments that were not run are not looked at. `file` is the baseline's.
[[nodiscard]] std::vector<CheckOutcome> held_against(const Baseline& baseline, const BaselineFigures& now,
                                                     const std::string& file);

}  // namespace footprint
