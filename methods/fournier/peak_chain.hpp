// The peaks of every texel of every mip level.
#pragma once

#include <cstddef>
#include <vector>

#include "methods/fournier/peak_fit.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/image/image.hpp"

namespace footprint::fournier {

/// Statistics of the fits of a chain. Errors as in `Fit`, weighted by area.
struct FitStatistics {
  std::size_t fits = 0;
  std::size_t not_converged = 0;
  double mean_error = 0.0;  ///< over all fitted texels
};

/// Peaks as images with 4 channels: axis on Lambert's disc (x, y), root of the spread (deviation), weight. The peaks of
/// a texel are sorted, heaviest first, and their weights sum to the share of its area that has normals.
struct PeakChain {
  std::vector<Image> first;              ///< each texel's heaviest peak, all levels
  std::vector<std::vector<Image>> rest;  ///< the others, one chain per peak; level 0 is level 1 of `first`
  FitStatistics statistics;
};

/// The start of a texel's fit: the merged peaks of the finer texels below it, or its own heaviest normals.
enum class Start { inherited, own };

/// How a texel is fitted: from which start, and the evaluations after which a fit stops.
struct FitRule {
  Start start = Start::inherited;
  int evaluations = most_evaluations;
};

/// Fits `count` peaks to every texel above the finest level; a texel of the finest level has its normal as its only
/// peak. `normals`: xyz and a weight of 0 or 1; texels of weight 0 have no peaks. `base_variance`: slope variance of
/// the lobe about each normal. `rest` has count - 1 chains, but at least one. Calls progress from this thread only.
/// Equal results at any number of threads.
[[nodiscard]] PeakChain fit_peak_chain(const Image& normals, double base_variance, std::size_t count, FitRule rule,
                                       const Progress& progress);

}  // namespace footprint::fournier
