// The moments that a texel stores of each part: weight, first moments about the part's centre, second moments, and
// values of the texel such as the variance of the base lobe. All are linear in the texels below. Moments are along the
// axes of the part.
#pragma once

#include <array>
#include <span>

#include "methods/cells/partition.hpp"

namespace footprint::cells {

/// The stored second moments of a part. full: all three, along the axes of the plane. axes: two, along the axes of the
/// part, in which the third is 0 over the whole map.
enum class Covariance { full, axes };

/// Channels per part: w, w dx, w dy, w dx^2, w dx dy, w dy^2 with d the distance from the part's centre along its axes.
/// `axes` leaves out w dx dy.
[[nodiscard]] constexpr int part_channels(Covariance covariance) { return covariance == Covariance::full ? 6 : 5; }

/// The origin and the axes of a part's moments.
struct PartFrame {
  glm::dvec2 centre{0.0};
  glm::dvec2 axis{1.0, 0.0};  ///< unit; the second axis is a quarter turn counter-clockwise

  [[nodiscard]] bool operator==(const PartFrame&) const = default;
};

/// The mean of each part over the whole map and, with `axes`, the direction of its largest spread. Parts without texels
/// have those of all texels.
[[nodiscard]] std::array<PartFrame, most_parts> part_frames(std::span<const PlanePoint> points,
                                                            std::span<const float> shares, std::size_t parts,
                                                            Covariance covariance);

/// The points of a whole map and their shares in the parts, row by row.
struct PartedPoints {
  std::span<const PlanePoint> points;
  std::span<const float> shares;
  std::size_t parts;
  int width, height;
};

/// The finest level of one layer: channels 4 layer to 4 layer + 3 of the channels of all parts in sequence, 0 beyond
/// the last part. The weights of a texel sum to the weight of its normal.
[[nodiscard]] Image moment_layer(const PartedPoints& map, const std::array<PartFrame, most_parts>& frames,
                                 Covariance covariance, int layer);

/// Layers of four channels for `channels` of all parts together.
[[nodiscard]] constexpr int layer_count(int channels) { return (channels + 3) / 4; }

/// The finest level of w v for parts 4 layer and following. v is the value of `values` (one channel) at the texel's
/// centre.
[[nodiscard]] Image value_layer(const PartedPoints& map, const Image& values, int layer);

}  // namespace footprint::cells
