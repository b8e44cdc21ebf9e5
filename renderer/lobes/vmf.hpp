// The von Mises-Fisher lobe of unit energy, kappa / (2 pi (1 - e^{-2 kappa})) e^{kappa (cos - 1)} (Xu 2017, equation
// 6): its peak, its mean, and kappa of the mean.
#pragma once

namespace footprint {

/// The integral of e^{kappa (cos - 1)} over the sphere, 2 pi (1 - e^{-2 kappa}) / kappa (Iwasaki 2012, equation 9);
/// 4 pi for kappa = 0.
[[nodiscard]] double vmf_integral(double kappa);

/// The density at the axis, 1/sr.
[[nodiscard]] double vmf_peak(double kappa);

/// 2 pi times the density at the axis, kappa / (1 - e^{-2 kappa}): 1/2 for kappa = 0.
[[nodiscard]] double vmf_amplitude(double kappa);

/// The length of the lobe's mean vector, A = coth kappa - 1 / kappa, over kappa, and the derivative of that quotient
/// over kappa: 1/3 and -2/45 for kappa = 0.
struct VmfMean {
  double by_kappa, slope_by_kappa;
};
[[nodiscard]] VmfMean vmf_mean(double kappa);

/// Banerjee et al. 2005 (p = 3): kappa = (3 r - r^3) / (1 - r^2) of the mean vector's length r, in q = 1 - r, which
/// keeps its digits where r is near 1. 0 < q <= 1.
[[nodiscard]] double vmf_kappa_of_shortfall(double q);

/// The inverse: the root in (0, 1] of q^3 + (kappa - 3) q^2 - 2 kappa q + 2 = 0, by Newton's steps. kappa >= 0.
[[nodiscard]] double vmf_shortfall(double kappa);

}  // namespace footprint
