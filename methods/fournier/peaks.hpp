// Sets of normals: their moments, the peaks that represent them, and the bins that pool them.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace footprint::fournier {

/// Normals about an axis. `spread` is their slope variance per axis, without that of the base lobe; it is 0 for a
/// single normal.
struct Peak {
  double weight = 0.0;                  ///< >= 0
  Eigen::Vector3d axis{0.0, 0.0, 1.0};  ///< unit
  double spread = 0.0;                  ///< >= 0
};

/// The weighted sum of unit normals; weights and sums of disjoint sets add. The sum of a peak has the length weight /
/// (1 + spread), because (1 - r) / r is the slope variance of normals whose mean has length r (Toksvig 2005).
struct Moments {
  double weight = 0.0;
  Eigen::Vector3d sum{0.0, 0.0, 0.0};

  void add(const Moments& other, double share = 1.0) {
    weight += share * other.weight;
    sum += share * other.sum;
  }
};

[[nodiscard]] Moments moments_of(const Peak& peak);

/// The inverse of moments_of. Normals that cancel give the axis (0, 0, 1) and `largest_spread`.
[[nodiscard]] Peak peak_of(const Moments& moments);

inline constexpr double largest_spread = 1e4;

/// Merges sets until at most `count` >= 1 remain, each time the pair whose union adds the least to the weighted
/// variance of the normals about the means of their sets (Ward 1963). Drops sets of weight 0. Sorted, heaviest first.
[[nodiscard]] std::vector<Peak> merged_peaks(std::vector<Moments> sets, std::size_t count);

/// Clusters single normals into `count` sets: the heaviest normals, `apart` (a chord) from each other if there are
/// enough, each with the normals nearest to it. Needs count >= 1 and at least as many normals. Sorted, heaviest first.
[[nodiscard]] std::vector<Peak> clustered_peaks(const std::vector<Peak>& normals, std::size_t count, double apart);

/// Lambert's azimuthal equal-area map of the sphere to the disc of radius 2 (the upper hemisphere has radius sqrt 2),
/// and its inverse. Unlike (x, y) alone it is well conditioned at the horizon. Downward normals map to (2, 0).
[[nodiscard]] Eigen::Vector2d disc_from_direction(const Eigen::Vector3d& direction);
[[nodiscard]] Eigen::Vector3d direction_from_disc(const Eigen::Vector2d& point);

/// Square cells of equal area on Lambert's disc. The normals of a cell are replaced by their moments.
class NormalCells {
 public:
  /// Cells of at most this edge.
  explicit NormalCells(double edge);

  /// Cells as wide as the deviation of the base lobe leave an error of fourth order. They are at least 1/16 wide, a
  /// slope variance of 1/3072, which limits the resolution of lobes above an exponent of about 3000.
  [[nodiscard]] static NormalCells of_lobe(double base_variance);

  [[nodiscard]] std::uint32_t cell_of(const Eigen::Vector3d& normal) const;

 private:
  double cells_per_unit_;
  std::uint32_t cells_per_edge_;
};

struct NormalBin {
  std::uint32_t cell = 0;
  std::uint32_t group = 0;  ///< normals of different groups stay apart
  Moments moments;
};

/// Bins sorted by group and cell, one per cell of a group.
using NormalBins = std::vector<NormalBin>;

/// Merges the bins of each cell of a group.
void unite_cells(NormalBins& bins);

/// The distribution that peaks are fitted to. group_spreads: a slope variance that each group adds; empty: none.
[[nodiscard]] std::vector<Peak> target_of(const NormalBins& bins, std::span<const double> group_spreads);

}  // namespace footprint::fournier
