// The least-squares fit of peaks to a distribution of normals, and the inner products of lobes that it needs.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "methods/fournier/peaks.hpp"

namespace footprint::fournier {

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

/// The integral over the sphere of the product of two lobes, in closed form (Iwasaki 2012, equation 10, in a form that
/// neither overflows nor cancels).
[[nodiscard]] double product(const VmfLobe& a, const VmfLobe& b);

/// The integrals of (a, da/dkappa, da/ds, da/dt) times b.
[[nodiscard]] Eigen::Vector4d products_with_derivatives(const VmfLobe& a, const VmfLobe& b);

/// The integrals of (a, da/dkappa, da/ds, da/dt), the rows, times (b, db/dkappa, db/ds, db/dt), the columns.
[[nodiscard]] Eigen::Matrix4d products_of_derivatives(const VmfLobe& a, const VmfLobe& b);

/// The result of one fit. Errors are L2 distances over the sphere between peaks and target, relative to the norm of the
/// target.
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
