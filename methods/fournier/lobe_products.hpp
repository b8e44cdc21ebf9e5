// Inner products over the sphere of lobes and of their derivatives: what a least-squares fit of lobes needs, exactly.
#pragma once

#include <Eigen/Core>

namespace footprint::fournier {

/// A von Mises-Fisher lobe of unit energy, kappa / (2 pi (1 - e^{-2 kappa})) e^{kappa (axis.h - 1)} (Xu 2017, equation
/// 6), kappa > 0, and the derivatives of its axis by two parameters.
struct VmfLobe {
  Eigen::Vector3d axis{0.0, 0.0, 1.0};  ///< unit
  double kappa = 1.0;
  Eigen::Vector3d axis_by_s{0.0, 0.0, 0.0};
  Eigen::Vector3d axis_by_t{0.0, 0.0, 0.0};
};

/// The integral over the sphere of the product of two lobes; closed form (Iwasaki 2012, equation 10, in a form that
/// neither overflows nor cancels).
[[nodiscard]] double product(const VmfLobe& a, const VmfLobe& b);

/// The integrals of (a, da/dkappa, da/ds, da/dt) times b.
[[nodiscard]] Eigen::Vector4d products_with_derivatives(const VmfLobe& a, const VmfLobe& b);

/// The integrals of (a, da/dkappa, da/ds, da/dt) times (b, db/dkappa, db/ds, db/dt): row a's, column b's.
[[nodiscard]] Eigen::Matrix4d products_of_derivatives(const VmfLobe& a, const VmfLobe& b);

}  // namespace footprint::fournier
