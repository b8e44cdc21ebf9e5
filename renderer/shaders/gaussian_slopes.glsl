// A Gaussian over slopes, to which the base lobe adds its variance. Includers define `const bool base_in_moments`: whether
// the moments of the texels include the base lobe.
#include "common_slopes.glsl"

#if ANISOTROPIC_LOBE
vec2 baseAlphas(float variance) {
  return base_in_moments ? vec2(sqrt(2.0 * variance)) : facetAlphas(lobeFromVariance(variance));
}

#endif
// A Gaussian over slopes with covariance S + v (Olano and Baker 2010), v the slope variance of the base lobe.
SlopeLobe slopeLobe(vec2 mean, mat2 spread, float variance) {
  float slope2 = dot(mean, mean);
  float q = sqrt(1.0 + slope2);
  mat2 inverse_jacobian = inverseSlopeJacobian(mean, q);
  mat2 local = inverse_jacobian * spread * inverse_jacobian;
  float least = max(variance, 1e-7 * (1.0 + slope2));  // below it, 32-bit moments are rounding
#if ANISOTROPIC_LOBE
  vec2 alphas = max(baseAlphas(variance), sqrt(2e-7 * (1.0 + slope2)));
  mat2 base = 0.5 * inFacetAxes(alphas.x * alphas.x, alphas.y * alphas.y);
  mat2 both = spread + base;
  // det (S + V) as a sum without cancellation: det S + det V + tr (adj S V).
  float determinant = determinantOfCovariance(spread) + 0.25 * alphas.x * alphas.x * alphas.y * alphas.y +
                      max(dot(adjugate(spread)[0], base[0]) + dot(adjugate(spread)[1], base[1]), 0.0);
  return SlopeLobe(mean, spread, variance, variance + 0.5 * (local[0][0] + local[1][1]), normalOfSlope(mean), q,
                   adjugate(both) / determinant, 1.0 / (2.0 * pi * sqrt(determinant)), 2.0 * (local + base));
#else
  float determinant = least * (least + spread[0][0] + spread[1][1]) + determinantOfCovariance(spread);
  return SlopeLobe(mean, spread, variance, variance + 0.5 * (local[0][0] + local[1][1]), normalOfSlope(mean), q,
                   adjugate(spread + mat2(least)) / determinant, 1.0 / (2.0 * pi * sqrt(determinant)));
#endif
}

// p22 / h_z^3: density over solid angle (dh = h_z^3 db).
float slopeDensity(SlopeLobe e, vec3 h) {
  countLobes(1);
  float cosine = max(h.z, smallest_slope_cosine);
  vec2 offset = -h.xy / cosine - e.mean;
  return e.scale * exp(-0.5 * max(dot(offset, e.shape * offset), 0.0)) / (cosine * cosine * cosine);
}

#if LOBES_LISTED
NormalLobe lobeInRow(vec3 axis, float variance, float lobe, float share) {
  return vmfNormalLobe(axis, 1.0 / variance, share, lobe);
}
#endif
