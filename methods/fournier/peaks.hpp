// Sets of normals: their moments, the peaks that represent them, the bins that pool them, and the least-squares fit of
// peaks to a distribution of normals, by inner products of lobes.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace footprint::fournier {

/// Normals about an axis. `spread` is their slope variance per axis without that of the base lobe; 0 for one normal.
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

/// The evaluations of Q after which a fit stops, unless it is given fewer.
inline constexpr int most_evaluations = 100;

/// A von Mises-Fisher lobe of unit energy, kappa / (2 pi (1 - e^{-2 kappa})) e^{kappa (axis.h - 1)} (Xu 2017, equation
/// 6), kappa > 0, and the derivatives of its axis by two parameters.
struct VmfLobe {
  Eigen::Vector3d axis{0.0, 0.0, 1.0};  ///< unit
  double kappa = 1.0;
  Eigen::Vector3d axis_by_s{0.0, 0.0, 0.0};
  Eigen::Vector3d axis_by_t{0.0, 0.0, 0.0};
};

/// The integral over the sphere of a product of two lobes (Iwasaki 2012, Eq. 10, without overflow or cancellation).
[[nodiscard]] double product(const VmfLobe& a, const VmfLobe& b);

/// The integrals of (a, da/dkappa, da/ds, da/dt) times b.
[[nodiscard]] Eigen::Vector4d products_with_derivatives(const VmfLobe& a, const VmfLobe& b);

/// The integrals of (a, da/dkappa, da/ds, da/dt), the rows, times (b, db/dkappa, db/ds, db/dt), the columns.
[[nodiscard]] Eigen::Matrix4d products_of_derivatives(const VmfLobe& a, const VmfLobe& b);

/// The result of one fit. Errors are L2 distances over the sphere from the target, relative to its norm.
struct Fit {
  std::vector<Peak> peaks;  ///< weights sum to the target's; heaviest first
  double start_error = 0.0;
  double error = 0.0;  ///< at most start_error
  bool converged = true;
};

/// Moves `start` to the nearest minimum of
///   Q = integral over the sphere of (sum_i w_i L(n_i, base_variance + spread_i) - T)^2,
///   T = sum_j b_j L(m_j, base_variance + spread_j),  w_i >= 0, sum w_i = sum b_j, spread_i >= 0,
/// where L(n, v) is the von Mises-Fisher lobe of unit energy and kappa = 1/v, the Blinn-Phong lobe of exponent 1/v to
/// O(v) (for Beckmann and GGX the lobe of the same slope variance). Levenberg-Marquardt over all w, n and spread at
/// once, of at most `evaluations` of Q. Neither may be empty; base_variance > 0.
[[nodiscard]] Fit fit_peaks(std::span<const Peak> target, std::span<const Peak> start, double base_variance,
                            int evaluations = most_evaluations);

}  // namespace footprint::fournier
