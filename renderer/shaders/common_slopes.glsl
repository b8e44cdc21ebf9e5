// Slope statistics, b = -n_xy / n_z with mean B and covariance S, and what the lobes over them share. A module includes
// stretched_slopes.glsl or gaussian_slopes.glsl, which define `slopeLobe` and `slopeDensity`.

const float smallest_slope_cosine = 1e-3;  // hard stop of slopes at the horizon

vec3 normalOfSlope(vec2 slope) { return normalize(vec3(-slope, 1.0)); }

// M - B B^T for second moments M = (xx, xy, yy), without the negative eigenvalues of rounding.
mat2 slopeCovariance(vec2 mean, vec3 second) {
  vec3 c = second - vec3(mean.x * mean.x, mean.x * mean.y, mean.y * mean.y);
  vec2 deviator = vec2(0.5 * (c.x - c.z), c.y);
  float middle = 0.5 * (c.x + c.z);
  float radius = length(deviator);
  if (middle >= radius) return mat2(c.x, c.y, c.y, c.z);
  float largest = max(middle + radius, 0.0);
  vec2 turn = deviator / max(radius, 1e-30);
  return 0.5 * largest * mat2(1.0 + turn.x, turn.y, turn.y, 1.0 - turn.x);
}

// The determinant of a covariance, at least 0 despite rounding.
float determinantOfCovariance(mat2 c) { return max(c[0][0] * c[1][1] - c[0][1] * c[1][0], 0.0); }

#if DIFFUSE
// The symmetric square root of a covariance.
mat2 covarianceRoot(mat2 c) {
  float s = sqrt(determinantOfCovariance(c));
  return (c + mat2(s)) / max(sqrt(c[0][0] + c[1][1] + 2.0 * s), 1e-12);
}

// The mean of the unit normals of Gaussian slopes, by 3 x 3 Gauss-Hermite points. root: of their covariance.
vec3 meanOfSlopes(vec2 mean, mat2 root) {
  vec3 sum = vec3(0.0);
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      float weight = (i == 0 ? 4.0 : 1.0) * (j == 0 ? 4.0 : 1.0) / 36.0;
      sum += weight * normalOfSlope(mean + root * (1.7320508 * vec2(i, j)));
    }
  }
  return sum;
}
#endif

// [d -b; -c a]: the inverse times the determinant.
mat2 adjugate(mat2 m) { return mat2(m[1][1], -m[0][1], -m[1][0], m[0][0]); }

// The Jacobian from slopes about the normal with slope B to slopes of the surface: J = diag(q^2, q) along and across B,
// q = 1 / n_z = sqrt(1 + B^2). This form avoids the direction of B, which is undefined for a flat surface.
mat2 slopeJacobian(vec2 mean, float q) { return mat2(q) + (q / (q + 1.0)) * outerProduct(mean, mean); }
mat2 inverseSlopeJacobian(vec2 mean, float q) { return mat2(1.0 / q) - outerProduct(mean, mean) / (q * q * (q + 1.0)); }

struct SlopeLobe {
  vec2 mean;      // B
  mat2 spread;    // S: covariance of the texels' slopes, without the base lobe
  float base;     // v: slope variance per axis of the base lobe, about a texel's own normal
  float breadth;  // slope variance per axis about `axis`, base lobe included: what a round lobe would have
  vec3 axis;      // the normal of slope B
  float secant;   // 1 / axis.z
  mat2 shape;     // stretched: offsets from B to offsets of the base lobe; Gaussian: inverse covariance
  float scale;    // stretched: determinant of `shape`; Gaussian: the peak of the density of slopes
#if ANISOTROPIC_LOBE
  mat2 widths;    // twice the covariance of slopes about `axis`, base lobe included: squared alphas
#endif
};

#if ANISOTROPIC_LOBE
// Alpha along and across the direction of the base lobe whose round mean has a slope variance, as far as the moments do
// not include it.
vec2 baseAlphas(float variance);

// The covariance of the slopes of that lobe about a texel's own normal.
mat2 baseCovariance(float variance) {
  vec2 alphas = baseAlphas(variance);
  return 0.5 * inFacetAxes(alphas.x * alphas.x, alphas.y * alphas.y);
}

#endif

#if LOBES_LISTED
// Splits an elongated lobe into a row of round ones along its long axis, for environment light: Gaussian weights and
// the same total variance. Five or seven up to 1.9 deviations; one if less than 1.3 times as long as wide.
struct LobeRow {
  int half_count;   // lobes to each side of the middle one
  float across;     // slope variance per axis about `axis` of each lobe
  vec2 step;        // from lobe to lobe, in slopes of the surface
};

LobeRow lobeRow(SlopeLobe e) {
  mat2 inverse_jacobian = inverseSlopeJacobian(e.mean, e.secant);
#if ANISOTROPIC_LOBE
  mat2 local = 0.5 * e.widths;
  float alpha = baseAlphas(e.base).y;
  float narrowest = 0.5 * alpha * alpha;
  float base = 0.0;  // `local` includes it
#else
  mat2 local = inverse_jacobian * e.spread * inverse_jacobian;
  float narrowest = e.base;
  float base = e.base;
#endif
  vec2 deviator = vec2(0.5 * (local[0][0] - local[1][1]), local[0][1]);
  float radius = length(deviator);
  float middle = base + 0.5 * (local[0][0] + local[1][1]);
  float across = max(middle - radius, max(narrowest, 1e-7));
  float ratio = (middle + radius) / across;
  if (ratio < 1.69) return LobeRow(0, e.breadth, vec2(0.0));
  vec2 along = deviator.x >= 0.0 ? vec2(radius + deviator.x, deviator.y) : vec2(deviator.y, radius - deviator.x);
  float excess = sqrt(2.0 * radius);
  vec2 unit = slopeJacobian(e.mean, e.secant) * normalize(along) * excess;
  return ratio <= 16.0 ? LobeRow(2, across, 1.0025 * unit) : LobeRow(3, across, 0.6869 * unit);
}

// A lobe of a row. variance: of its slopes, per axis. lobe: the parameter of a base lobe of that variance.
NormalLobe lobeInRow(vec3 axis, float variance, float lobe, float share);

NormalLobe lobeOfRow(SlopeLobe e, LobeRow row, int i) {
  int steps = i - row.half_count;
  vec3 axis = normalOfSlope(e.mean + float(steps) * row.step);
  float x = row.half_count == 0 ? 0.0 : 1.9 * float(steps) / float(row.half_count);
  float share = exp(-0.5 * x * x) / (row.half_count == 0 ? 1.0 : row.half_count == 2 ? 2.6026 : 3.8622);
  float lobe = lobeFromVariance(row.across);
  return lobeInRow(axis, row.across, lobe, share);
}
#endif
