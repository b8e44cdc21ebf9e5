// Spherical Gaussians: values, integrals and convolutions in forms that neither overflow nor cancel.
#pragma once

#include <glm/glm.hpp>

namespace footprint::iwasaki_sg {

/// exp(sharpness (w.axis - 1)): an SG of unit amplitude (Iwasaki 2012, Eq. 3).
struct SphericalGaussian {
  glm::dvec3 axis{0.0, 0.0, 1.0};  ///< unit
  double sharpness = 1.0;          ///< eta, above 0

  friend bool operator==(const SphericalGaussian&, const SphericalGaussian&) = default;
};

/// 1 - a.b of unit vectors, from their difference: exact where the dot product has lost it.
[[nodiscard]] inline double one_minus_dot(const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 d = a - b;
  return 0.5 * glm::dot(d, d);
}

/// The SG at a unit vector.
[[nodiscard]] double value(const SphericalGaussian& lobe, const glm::dvec3& direction);

/// The integral of the product of two SGs over the sphere (Eq. 11), to rounding for any sharpness up to 1e6 and above.
[[nodiscard]] double convolution(const SphericalGaussian& a, const SphericalGaussian& b);

/// The same as one SG in the angle between the axes (Eq. 14): good where both are sharp. The largest error is
/// 1.45 / (eta1 + eta2)^2 in the limit, 1.6 / (eta1 + eta2)^2 where they sum to 10 or more.
[[nodiscard]] double approximate_convolution(const SphericalGaussian& a, const SphericalGaussian& b);

}  // namespace footprint::iwasaki_sg
