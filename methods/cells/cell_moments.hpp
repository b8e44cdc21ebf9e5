// What a texel stores of each part: weight, first moments about the part's centre, second moments, and the base lobe's
// variance, all linear in the texels below. Moments are along axes of the part's own.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "methods/cells/partition.hpp"

namespace footprint::cells {

/// Which second moments of a part are kept: all three, along the plane's axes, or the two along the part's own, in
/// which the third is 0 over the whole map.
enum class Covariance { full, axes };

/// Moments of a part with d the distance from its centre, along its axes: w, w dx, w dy, w dx^2, w dx dy, w dy^2; with
/// `axes` all but w dx dy.
[[nodiscard]] constexpr int part_channels(Covariance covariance) { return covariance == Covariance::full ? 6 : 5; }

/// Where a part's moments are taken about, and along what.
struct PartFrame {
  glm::dvec2 centre{0.0};
  glm::dvec2 axis{1.0, 0.0};  ///< unit; the other one is a quarter turn further, counter-clockwise

  [[nodiscard]] bool operator==(const PartFrame&) const = default;
};

/// The mean of every part over the whole map, and with `axes` the direction in which it spreads the most; parts without
/// texels have those of all.
[[nodiscard]] std::array<PartFrame, most_parts> part_frames(std::span<const PlanePoint> points,
                                                            std::span<const float> shares, std::size_t parts,
                                                            Covariance covariance);

/// Of a whole map, row by row.
struct PartedPoints {
  std::span<const PlanePoint> points;
  std::span<const float> shares;
  std::size_t parts;
  int width, height;
};

/// The finest level of channel 4 layer + c, c of 0 to 3, of all parts' channels one after the other: what no part has
/// is 0. A texel's weights sum to the weight of its normal.
[[nodiscard]] Image moment_layer(const PartedPoints& map, const std::array<PartFrame, most_parts>& frames,
                                 Covariance covariance, int layer);

/// Layers of four channels for so many of all parts together.
[[nodiscard]] constexpr int layer_count(int channels) { return (channels + 3) / 4; }

/// The finest level of w v, v the value of `variance` (one channel) under a texel's middle, of parts 4 layer and on.
[[nodiscard]] Image variance_layer(std::span<const PlanePoint> points, std::span<const float> shares, std::size_t parts,
                                   const Image& variance, int width, int height, int layer);

}  // namespace footprint::cells
