// What a texel stores of each part: weight, first moments about the part's centre, second moments, and the base lobe's
// variance, all linear in the texels below.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "methods/cells/partition.hpp"

namespace footprint::cells {

/// Moments of a part: w, w dx, w dy, w dx^2, w dx dy, w dy^2 with d the distance from the part's centre.
constexpr int part_channels = 6;

/// The mean of every part over the whole map; parts without texels have that of all.
[[nodiscard]] std::array<glm::dvec2, most_parts> part_centres(std::span<const PlanePoint> points,
                                                              std::span<const float> shares, std::size_t parts);

/// The finest level of channel 4 layer + c, c of 0 to 3, of all parts' channels one after the other: what no part has
/// is 0. A texel's weights sum to the weight of its normal.
[[nodiscard]] Image moment_layer(std::span<const PlanePoint> points, std::span<const float> shares, std::size_t parts,
                                 const std::array<glm::dvec2, most_parts>& centres, int width, int height, int layer);

/// Layers of four channels for so many of all parts together.
[[nodiscard]] constexpr int layer_count(int channels) { return (channels + 3) / 4; }

/// The finest level of w v, v the value of `variance` (one channel) under a texel's middle, of parts 4 layer and on.
[[nodiscard]] Image variance_layer(std::span<const PlanePoint> points, std::span<const float> shares, std::size_t parts,
                                   const Image& variance, int width, int height, int layer);

}  // namespace footprint::cells
