// Sets of normals: their moments, the peaks that represent them, and the bins that pool them.
#pragma once

#include <Eigen/Core>
#include <cstdint>
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

/// Cells of the sphere, squares of one area on Lambert's disc. Normals of one cell are told by their moments. An edge
/// of the base lobe's own deviation leaves an error of fourth order; below 1/16 it stops, and lobes narrower than that
/// are told in the distribution of normals under a texel by cells of a slope variance of 1/3072, an exponent of about
/// 3000.
class NormalCells {
 public:
  explicit NormalCells(double base_variance);

  [[nodiscard]] std::uint32_t cell_of(const Eigen::Vector3d& normal) const;

 private:
  double cells_per_unit_;
  std::uint32_t cells_per_edge_;
};

struct NormalBin {
  std::uint32_t cell = 0;
  Moments moments;
};

/// Sorted by cell, each cell once.
using NormalBins = std::vector<NormalBin>;

/// Makes one bin of all those of a cell.
void unite_cells(NormalBins& bins);

/// What the peaks are fitted to.
[[nodiscard]] std::vector<Peak> target_of(const NormalBins& bins);

}  // namespace footprint::fournier
