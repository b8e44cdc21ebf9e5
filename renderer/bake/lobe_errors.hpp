// What simple lobes lose on a normal map: their errors against the sum of all texels' lobes, by the size of a
// footprint.
#pragma once

#include <array>

#include "renderer/image/image.hpp"

namespace footprint {

/// Of one texel's own lobe, one about the mean normal, one that the variance widens, and one that the slopes'
/// covariance widens (LEAN): root mean squares of the difference, over the mean of the exact values.
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
