// Figures composed of a run's pictures as a paper composes its own: rows, columns, crops and insets.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/runner/experiment.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// Reads the run's pictures back from `folder` and writes FOLDER/images/figure.png and, where a method is shown,
/// figure_errors.png (the same pictures' errors in false colour over the scale's legend). Returns their paths from the
/// folder; empty for a layout without rows. The run has every frame of the layout (check_against_scenes). Errors
/// (machine): a picture cannot be read or written.
[[nodiscard]] std::vector<std::string> write_figures(const FigureLayout& layout, const Experiment& experiment,
                                                     const Results& results, const std::filesystem::path& folder);

/// The part of a picture that `crop` leaves: whole pixels, one at least.
[[nodiscard]] Image cropped(const Image& picture, const Crop& crop);

/// `picture` with its part `inset` enlarged by whole factors to about `share` of its width, framed, in the lower right
/// corner.
[[nodiscard]] Image with_inset(const Image& picture, const Crop& inset, double share = 0.4);

}  // namespace footprint
