// A set of normals told by its moments, how two become one, and how one is stored.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace footprint::fournier {

/// Normals about an axis. `spread` is their slope variance per axis, without that of the base lobe: 0 for one normal.
struct Peak {
  double weight = 0.0;                  ///< >= 0
  Eigen::Vector3d axis{0.0, 0.0, 1.0};  ///< unit
  double spread = 0.0;                  ///< >= 0
};

/// The weighted sum of unit normals: weights and sums of disjoint sets add. A peak has the sum whose length is
/// weight / (1 + spread): (1 - r) / r is the slope variance of normals whose mean has length r (Toksvig 2005).
struct Moments {
  double weight = 0.0;
  Eigen::Vector3d sum{0.0, 0.0, 0.0};

  void add(const Moments& other, double share = 1.0) {
    weight += share * other.weight;
    sum += share * other.sum;
  }
};

[[nodiscard]] Moments moments_of(const Peak& peak);

/// The inverse; the axis of normals that cancel is (0, 0, 1), their spread `largest_spread`.
[[nodiscard]] Peak peak_of(const Moments& moments);

inline constexpr double largest_spread = 1e4;

/// At most `count` >= 1 sets: the pair whose union adds the least to the weighted variance of the normals about their
/// sets' means (Ward 1963) becomes one, again and again. Sets of weight 0 are dropped. Heaviest first.
[[nodiscard]] std::vector<Peak> merged_peaks(std::vector<Moments> sets, std::size_t count);

/// `count` sets out of single normals, `apart` (a chord) from each other where there are as many: the heaviest normals,
/// each with those that are nearest to it. For count >= 1 and at least as many normals. Heaviest first.
[[nodiscard]] std::vector<Peak> clustered_peaks(const std::vector<Peak>& normals, std::size_t count, double apart);

/// Lambert's azimuthal equal-area map of the sphere to the disc of radius 2 (the upper hemisphere: sqrt 2), and back:
/// well conditioned at the horizon too, where (x, y) alone is not. Downright normals go to (2, 0).
[[nodiscard]] Eigen::Vector2d disc_from_direction(const Eigen::Vector3d& direction);
[[nodiscard]] Eigen::Vector3d direction_from_disc(const Eigen::Vector2d& point);

}  // namespace footprint::fournier
