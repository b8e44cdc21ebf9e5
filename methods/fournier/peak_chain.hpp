// The peaks of every texel of every mip level.
#pragma once

#include <cstddef>
#include <vector>

#include "renderer/core/progress.hpp"
#include "renderer/image/image.hpp"

namespace footprint::fournier {

/// How the fits of a chain went. Errors as in `Fit`, weighted by area.
struct FitStatistics {
  std::size_t fits = 0;
  std::size_t not_converged = 0;
  double mean_error = 0.0;  ///< over all texels that were fitted
};

/// Peaks as images: 4 channels, the axis on Lambert's disc (x, y), the root of the spread (deviation), and the weight.
/// A texel's weights sum to the part of it that has a normal, heaviest first, then zeros.
struct PeakChain {
  std::vector<Image> first;              ///< each texel's heaviest peak, all levels
  std::vector<std::vector<Image>> rest;  ///< the others, one chain a peak, of which level 0 is level 1 of `first`
  FitStatistics statistics;
};

/// Where the fit of a texel starts from: the peaks of the finer texels below it, merged, or its own heaviest normals.
enum class Start { inherited, own };

/// Fits `count` peaks to every texel above the finest level, whose only peak is its normal. `normals`: xyz and a weight
/// of 0 or 1; weights of 0 leave a texel without peaks. `base_variance`: of the lobe about each normal. `rest` has one
/// chain less than `count`, but at least one. Progress is called from this thread alone. The same at any number of
/// threads.
[[nodiscard]] PeakChain fit_peak_chain(const Image& normals, double base_variance, std::size_t count, Start start,
                                       const Progress& progress);

}  // namespace footprint::fournier
