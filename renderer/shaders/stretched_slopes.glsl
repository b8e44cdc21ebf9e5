// The base lobe stretched to the slopes of a footprint, of which it keeps the distribution.
#include "common_slopes.glsl"

#if ANISOTROPIC_LOBE
vec2 baseAlphas(float variance) { return facetAlphas(lobeFromVariance(variance)); }

#endif
// The base lobe about `axis`, stretched by the linear map of slopes that takes its covariance W = v J J^T to the
// footprint's S + W. `shape` is the inverse of that map, J X^-1/2 J^-1 with X = 1 + J^-1 S J^-1 / v.
// The square root of a 2 x 2 matrix is X^1/2 = (X + s) / t, s^2 = det X, t^2 = tr X + 2 s. det X = 1 + tr + det of the
// rest is a sum without cancellation.
// For an anisotropic lobe W = J V J with its covariance V: the map is J N X^1/2 (J N)^-1 with N = (V / v)^1/2 and X = 1 +
// (J N)^-1 S (J N)^-T / v, which leaves the base lobe of equal slopes as it is.
SlopeLobe slopeLobe(vec2 mean, mat2 spread, float variance) {
  float q = sqrt(1.0 + dot(mean, mean));
  mat2 inverse_jacobian = inverseSlopeJacobian(mean, q);
  mat2 local = inverse_jacobian * spread * inverse_jacobian;
#if ANISOTROPIC_LOBE
  vec2 deviations = baseAlphas(variance) * inversesqrt(2.0 * variance);
  mat2 narrowed = inFacetAxes(1.0 / deviations.x, 1.0 / deviations.y);
  mat2 ratio = narrowed * local * narrowed / variance;
#else
  mat2 ratio = local / variance;
#endif
  float trace = ratio[0][0] + ratio[1][1];
  float s = sqrt(1.0 + trace + determinantOfCovariance(ratio));
  float t = sqrt(2.0 + trace + 2.0 * s);
  mat2 inverse_root = (adjugate(mat2(1.0) + ratio) + mat2(s)) / (s * t);
#if ANISOTROPIC_LOBE
  mat2 widened = inFacetAxes(deviations.x, deviations.y);
  return SlopeLobe(mean, spread, variance, variance + 0.5 * (local[0][0] + local[1][1]), normalOfSlope(mean), q,
                   slopeJacobian(mean, q) * widened * inverse_root * narrowed * inverse_jacobian, 1.0 / s,
                   2.0 * (local + baseCovariance(variance)));
#else
  return SlopeLobe(mean, spread, variance, variance * (1.0 + 0.5 * trace), normalOfSlope(mean), q,
                   slopeJacobian(mean, q) * inverse_root * inverse_jacobian, 1.0 / s);
#endif
}

// Density over solid angle: D(h) dh = D_base(h') dh' with dh = h_z^3 db, which preserves the energy of the base lobe.
float slopeDensity(SlopeLobe e, vec3 h) {
  float cosine = max(h.z, smallest_slope_cosine);
  vec3 base = normalOfSlope(e.mean + e.shape * (-h.xy / cosine - e.mean));
  float ratio = base.z / cosine;
  return baseDensity(lobeFromVariance(e.base), e.axis, base) * (e.scale * ratio * ratio * ratio);
}

#if LOBES_LISTED
NormalLobe lobeInRow(vec3 axis, float variance, float lobe, float share) { return baseNormalLobe(axis, lobe, share); }
#endif
