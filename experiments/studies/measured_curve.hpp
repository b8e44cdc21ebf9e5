// The curve of plain supersampling over a stage: what so many frames of `direct`, averaged, reach and take.
#pragma once

#include <span>
#include <vector>

#include "experiments/studies/stage.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// The reference of errors in one view.
struct ErrorTarget {
  const View& view;
  double distance;         ///< its name in the curve
  const Image& reference;  ///< RGBA
  const Image& interior;   ///< a mask
  float exposure = 1;
};

/// A point for each count of frames that the settings name. The stage's first method is `direct`.
[[nodiscard]] std::vector<SupersamplingPoint> measured_curve(const Stage& stage, const ReferenceSettings& settings,
                                                             const ErrorTarget& target, ProgressParts& progress);

/// The curve's weight in progress, in samples per pixel.
[[nodiscard]] double curve_weight(std::span<const int> counts);

}  // namespace footprint
