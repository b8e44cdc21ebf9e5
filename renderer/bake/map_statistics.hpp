// A normal map by the size of a footprint: how far normals spread, in which directions, how unlike a Gaussian, and the
// errors of simple lobes.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "renderer/image/image.hpp"

namespace footprint {

/// Figures over all blocks of 2^level x 2^level texels of a map; blocks at the right and lower edge may be smaller.
struct LevelStatistics {
  int level = 0;
  double resultant = 1;   ///< mean length of the mean normal (Toksvig 2005): 1 if the normals of each block are equal
  double variance = 0;    ///< mean slope variance per axis, half the trace of the covariance
  double anisotropy = 0;  ///< (a - b) / (a + b) of its eigenvalues a >= b, a mean weighted by a + b: 0 round, 1 a line
  double tails = 1;  ///< fourth central moments over those of Gaussians of equal variance: 1 Gaussian, 1/3 two slopes
};

/// The share of texels whose stored values, decoded as 2 c - 1, are a vector out of the surface with a length within
/// 0.1 of 1. Photographs and heights in the place of normals have a small share. stored: at least 3 channels of 0 to 1;
/// with fewer the share is 0.
[[nodiscard]] double unit_share(const Image& stored);

/// A level for each power of two from 2 to the map's shorter side.
/// normals: 4 channels, as Material::normal_map. Texels of weight 0 do not count; a block without others is left out.
/// Slopes are limited to steepest_slope.
[[nodiscard]] std::vector<LevelStatistics> map_statistics(const Image& normals);

/// The correlation of a map's value with the slope variance under it, over blocks of 2^level texels: -1 to 1; none if
/// either is constant.
/// values: the first channel counts; of the size of the normals, else Error (usage).
[[nodiscard]] std::optional<double> correlation_with_spread(const Image& normals, const Image& values, int level);

/// The errors of four lobes: one texel's own, one about the mean normal, one that the variance widens, and one that the
/// slopes' covariance widens (LEAN). Each is the root mean square of the difference, over the mean of the exact values.
using LobeErrors = std::array<double, 4>;

/// The errors over 1024 blocks of 2^level x 2^level texels, above level 5 fewer, at places from a fixed seed, for GGX
/// in slope space and the half vectors of the study of real maps: a flat surface that is seen and lit as its scenes are
/// (docs/results/real-maps.md). normals: 4 channels, as Material::normal_map; texels of weight 0 count as flat. At
/// least 1 x 1. alphas: the base lobe's alpha, above 0; one channel, of the size of the normals or 1 x 1; else Error
/// (usage). level: 0 or more; blocks are cut to the map's size.
[[nodiscard]] LobeErrors lobe_errors(const Image& normals, const Image& alphas, int level);

/// The mean of the first channel of a map of at least one texel.
[[nodiscard]] double mean_of(const Image& map);

}  // namespace footprint
