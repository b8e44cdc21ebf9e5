// The K lobes of one texel that are nearest to the distribution of its normals, convolved with the base lobe.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "methods/best_lobes/lobe_shapes.hpp"
#include "methods/fournier/peaks.hpp"

namespace footprint::best_lobes {

/// The result of one fit.
struct LobeFit {
  std::vector<FittedLobe> lobes;  ///< heaviest first
  /// L2 distance to the target over the directions above the surface, relative to the norm of the target.
  double error = 0.0;
  bool converged = true;  ///< whether the last minimisation ended before its most evaluations
  bool resolved = true;   ///< whether the base lobe is wide enough; else the fit has a wider one, and is no bound
};

/// Mixtures of a number of lobes that a fit starts from, next to its own.
using Starts = std::function<std::vector<std::vector<FittedLobe>>(std::size_t count)>;

/// The edge of the cells of Lambert's disc that normals are pooled in: a sixteenth of the base lobe's deviation.
[[nodiscard]] double cell_edge(const LobeFamily& family);

/// The weights of the lobes together: those of the target, or as the fit has them. One lobe for facets of different
/// roughness has not their energy.
enum class Weights { of_target, free };

/// Fits 1 to `count` lobes, one more after the other, each time from several starts, and keeps the best of all. Where
/// it is resolved, the error exceeds neither that of any mixture of `starts` nor that of fewer lobes. target: pooled
/// normals, not empty; their spread is small against the base lobe.
[[nodiscard]] LobeFit fit_lobes(std::span<const fournier::Peak> target, std::size_t count, const LobeFamily& family,
                                const Starts& starts, Weights weights = Weights::of_target);

}  // namespace footprint::best_lobes
