// Spherical Gaussians of unit amplitude, e^{eta (w.axis - 1)}: twins of spherical_gaussian.cpp.

#include "vmf.glsl"

// The fit represents a discretised normal by a lobe of this sharpness (lobe_fit.hpp). Removing this width, which no
// facet has, keeps normals that agree from widening the base lobe.
const float sharpest = 1e6;
float ownSharpness(float eta) { return 1.0 / max(1.0 / eta - 1.0 / sharpest, 1e-9); }

// Iwasaki 2012, equation 9.
float sgIntegral(float eta) { return eta > 0.0 ? 2.0 * pi * oneMinusExp2(eta) / eta : 4.0 * pi; }

// Equation 11. |z| - eta1 - eta2 is computed from the difference of the axes, because sinh as printed overflows.
float sgConvolution(vec3 axis1, float eta1, vec3 axis2, float eta2) {
  float sum = eta1 + eta2;
  float z = length(eta1 * axis1 + eta2 * axis2);
  if (z < 1e-4) return 4.0 * pi * exp(-sum) * (1.0 + z * z / 6.0);
  float fall = -2.0 * eta1 * (eta2 / (z + sum)) * oneMinusDot(axis1, axis2);
  return 2.0 * pi * exp(fall) * (oneMinusExp2(z) / z);
}

// Equation 14.
float sgApproximateConvolution(vec3 axis1, float eta1, vec3 axis2, float eta2) {
  float sum = eta1 + eta2;
  return 2.0 * pi / sum * exp(-eta1 * (eta2 / sum) * oneMinusDot(axis1, axis2));
}
