// Integrals and convolutions of spherical Gaussians, Eqs. 11 and 14.
#include "methods/iwasaki_sg/spherical_gaussian.hpp"

#include <cmath>
#include <numbers>

namespace footprint::iwasaki_sg {

using std::numbers::pi;

double value(const SphericalGaussian& lobe, const glm::dvec3& direction) {
  return std::exp(-lobe.sharpness * one_minus_dot(lobe.axis, direction));
}

double convolution(const SphericalGaussian& a, const SphericalGaussian& b) {
  const double sum = a.sharpness + b.sharpness;
  const double z = glm::length(a.sharpness * a.axis + b.sharpness * b.axis);
  // sinh(z) / z as z goes to 0.
  if (z < 1e-4) return 4.0 * pi * std::exp(-sum) * (1.0 + z * z / 6.0);
  // z - sum without the cancellation: z^2 = sum^2 - 2 eta1 eta2 (1 - cos).
  const double fall = -2.0 * a.sharpness * b.sharpness * one_minus_dot(a.axis, b.axis) / (z + sum);
  return -2.0 * pi * std::exp(fall) * std::expm1(-2.0 * z) / z;
}

double approximate_convolution(const SphericalGaussian& a, const SphericalGaussian& b) {
  const double sum = a.sharpness + b.sharpness;
  return 2.0 * pi / sum * std::exp(-a.sharpness * b.sharpness / sum * one_minus_dot(a.axis, b.axis));
}

}  // namespace footprint::iwasaki_sg
