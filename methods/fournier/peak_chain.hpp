// The peaks of every texel of every mip level.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "methods/fournier/peaks.hpp"
#include "renderer/bake/prefiltered.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/image/image.hpp"
#include "renderer/scene/material.hpp"

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

/// The values that a texel stores for one peak: the four channels of `PeakChain`.
using Layer = std::array<float, 4>;
[[nodiscard]] Layer layer_of(const Peak& peak);

/// The result of a fit to the normals of one texel.
struct TexelFit {
  std::vector<Layer> layers;  ///< at most ChainSettings::layers
  bool fitted = false;
  bool converged = true;
  double error = 0.0;
};

/// A texel of a level above the finest, row by row.
struct TexelPlace {
  std::size_t level, texel;
};

/// Fits one texel. target: its normals, pooled; children: the peaks of the texels below. Called from several threads.
using FitTexel =
    std::function<TexelFit(const TexelPlace& place, const std::vector<Peak>& target, std::vector<Moments> children)>;

struct ChainSettings {
  NormalCells cells;           ///< that pool normals
  std::size_t peaks = 1;       ///< a texel of no more pooled normals than this is not fitted: they are its first layers
  std::size_t layers = 1;      ///< of a texel
  bool from_children = false;  ///< whether fits receive `children`
  std::span<const std::uint32_t> groups{};  ///< of the finest level's texels: NormalBin::group; empty: one for all
  std::span<const double> group_spreads{};  ///< slope variance that each group adds to that of its normals
};

/// The chain of a texel fit. `normals`: xyz and a weight of 0 or 1; texels of weight 0 have no peaks. A texel of the
/// finest level has its normal as its only peak. `rest` has layers - 1 chains, but at least one. Calls progress from
/// this thread only. Equal results at any number of threads.
[[nodiscard]] PeakChain fit_chain(const Image& normals, const ChainSettings& settings, const FitTexel& fit,
                                  const Progress& progress);

/// Adds the textures METHOD_first and METHOD_rest of a chain over a material's normal map, METHOD_mean (the mean
/// normal) with Effect::diffuse, and a note on fits that stopped early.
void add_peaks(const std::string& method, PeakChain chain, const Material& material, Storage storage,
               const EffectSet& effects, Prefiltered& out);

/// The start of a texel's fit: the merged peaks of the finer texels below it, or its own heaviest normals.
enum class Start { inherited, own };

/// How a texel is fitted: from which start, and the evaluations after which a fit stops.
struct FitRule {
  Start start = Start::inherited;
  int evaluations = most_evaluations;
};

/// The chain of `count` peaks by `fit_peaks`. `base_variance`: slope variance of the lobe about each normal.
[[nodiscard]] PeakChain fit_peak_chain(const Image& normals, double base_variance, std::size_t count, FitRule rule,
                                       const Progress& progress);

}  // namespace footprint::fournier
