// A part with moments of stereographic coordinates, p = h_xy / (1 + h_z). They are conformal: a lobe of slope variance
// v about the normal at p has the covariance v ((1 + |p|^2) / 2)^2 I there for any tilt. The square of a chord is 4 |p
// - p'|^2 / ((1 + |p|^2) (1 + |p'|^2)), and a solid angle 4 dp / (1 + |p|^2)^2. Includers define `const bool
// fast_density`, which replaces the power of a Blinn-Phong lobe by a faster one.

struct Part {
  vec2 mean;
#if ANISOTROPIC_LOBE
  mat2 shrink;
#else
  vec3 shrink;    // xx, xy, yy of A: distances from the mean to those of the base lobe
#endif
  float metric;   // 1 + |mean|^2
  float scale;    // share times det A, and what goes below the horizon; 0: the part is not there
  vec3 axis;
  float share;    // of the footprint
  float lobe;     // parameter of a facet's lobe
  float breadth;  // slope variance per axis about `axis`, a facet's lobe included
#if ANISOTROPIC_LOBE
  mat2 widths;    // squared alphas of both about `axis`
#endif
};

struct Direction {
  vec2 p;
  float metric;  // 1 + |p|^2
};

Direction directionOf(vec3 h) {
  vec2 p = h.xy / max(1.0 + h.z, 1e-3);
  return Direction(p, 1.0 + dot(p, p));
}

Part absentPart() {
#if ANISOTROPIC_LOBE
  return Part(vec2(0.0), mat2(0.0), 1.0, 0.0, vec3(0.0, 0.0, 1.0), 0.0, lobe_cutoff.x, 1.0,
              mat2(1.0));
#else
  return Part(vec2(0.0), vec3(0.0), 1.0, 0.0, vec3(0.0, 0.0, 1.0), 0.0, lobe_cutoff.x, 1.0);
#endif
}

#if DISTRIBUTION_GGX
// The base lobe ends 90 degrees from its axis. The stretch moves the part beyond the cosine (s - 1) / (s + 1), s = 1 /
// det A, below the horizon. Tails of GGX compensate: int_0^c 2 a^2 dx / (1 - t^2 x^2)^2, t^2 = 1 - a^2, of the energy.
float tailsGivenBack(float alpha, float s) {
  float a2 = alpha * alpha;
  float t = sqrt(max(1.0 - a2, 1e-4));
  float c = (s - 1.0) / (s + 1.0);
  float beyond = a2 * (c / (1.0 - t * t * c * c) + 0.5 * log((1.0 + t * c) / (1.0 - t * c)) / t);
  float energy = lobeEnergy(alpha);
  return energy / max(energy - beyond, 0.5 * energy);
}
#else
float tailsGivenBack(float lobe, float s) { return 1.0; }
#endif

// A = X^(-1/2) with X = I + spread / w; w is the variance of the base lobe in these coordinates. The square root of a 2
// x 2 matrix is X^(1/2) = (X + s I) / t, s^2 = det X, t^2 = tr X + 2 s. det X = 1 + tr + det of the rest is a sum
// without cancellation.
Part stretchedPart(float share, vec2 mean, vec3 spread, float lobe, float variance) {
  float metric = 1.0 + dot(mean, mean);
  vec3 ratio = spread / (0.25 * variance * metric * metric);
#if ANISOTROPIC_LOBE
  // A = N X^(-1/2) N^-1 with the covariance v N^2 of an anisotropic lobe, and X = I + N^-1 spread N^-1 / w. The projection
  // turns nothing, because a facet's direction turns by the shortest rotation.
  mat2 widths = 2.0 * variance * mat2(ratio.x, ratio.y, ratio.y, ratio.z) + squaredWidths(lobe);
  vec2 deviations = facetAlphas(lobe) * inversesqrt(2.0 * variance);
  mat2 narrowed = inFacetAxes(1.0 / deviations.x, 1.0 / deviations.y);
  mat2 own = narrowed * mat2(ratio.x, ratio.y, ratio.y, ratio.z) * narrowed;
  ratio = vec3(own[0][0], own[0][1], own[1][1]);
#endif
  float trace = ratio.x + ratio.z;
  float s = sqrt(1.0 + trace + max(ratio.x * ratio.z - ratio.y * ratio.y, 0.0));
  float t = sqrt(2.0 + trace + 2.0 * s);
  vec3 shrink = vec3(1.0 + ratio.z + s, -ratio.y, 1.0 + ratio.x + s) / (s * t);
  vec3 axis = vec3(2.0 * mean, 2.0 - metric) / metric;
#if ANISOTROPIC_LOBE
  mat2 both = inFacetAxes(deviations.x, deviations.y) * mat2(shrink.x, shrink.y, shrink.y, shrink.z) * narrowed;
  return Part(mean, both, metric, share / s * tailsGivenBack(lobe, s), axis, share, lobe, 0.25 * (widths[0][0] + widths[1][1]), widths);
#else
  return Part(mean, shrink, metric, share / s * tailsGivenBack(lobe, s), axis, share, lobe, variance * (1.0 + 0.5 * trace));
#endif
}

#if DIFFUSE
// The mean of the unit normals (2 p, 1 - |p|^2) / q, q = 1 + |p|^2, of a part, about the known mean m of q. To second
// order the mean of 1/q is (1 + var q / m^2) / m, and that of p / q is (mean (1 + var q / m^2) - cov(p, q) / m) / m,
// with cov(p, q) = 2 S mean and var q = 4 mean^T S mean. It stays bounded for wide spreads.
vec3 meanNormalOf(vec2 mean, vec3 spread) {
  vec2 along = vec2(dot(spread.xy, mean), dot(spread.yz, mean));
  float m = 1.0 + dot(mean, mean) + spread.x + spread.z;
  float widened = 1.0 + 4.0 * dot(mean, along) / (m * m);
  return vec3(2.0 * (mean * widened - 2.0 * along / m), 2.0 * widened - m) / m;
}
#endif

#if DISTRIBUTION_BLINN_PHONG
// The base lobe at u = 1 - cosine, below 2.
// (1 - u)^s. log2(1 - u) loses the last bits of u and is accurate to 2^-24 s. For larger s the series is used, accurate
// to 17 u^3 / 4 where the lobe is not negligible, u < 17 / s.
float fastLobeAt(float s, float u) {
  float series = -1.4426950 * u * (1.0 + u * (0.5 + u * (1.0 / 3.0)));
  float exponent = s > 1000.0 ? series : log2(max(1.0 - u, 1e-30));
  return (s + 1.0) / (2.0 * pi) * exp2(s * exponent);
}

float lobeAt(float s, float u) {
  if (fast_density) return fastLobeAt(s, u);
  return u >= 1.0 ? 0.0 : (s + 1.0) / (2.0 * pi) * exp(s * log1m(u));
}
#elif DISTRIBUTION_VMF
#include "vmf.glsl"
float lobeAt(float kappa, float u) {
  float safe = max(kappa, 1e-4);
  return safe / (2.0 * pi * oneMinusExp2(safe)) * exp(-safe * u);
}
#elif DISTRIBUTION_BECKMANN
float lobeAt(float alpha, float u) {
  float c = 1.0 - u;
  if (c <= 1e-3) return 0.0;
  float c2 = c * c;
  float a2 = alpha * alpha;
  return exp(-u * (2.0 - u) / (c2 * a2)) / (pi * a2 * c2 * c2);
}
#else
float lobeAt(float alpha, float u) {
  float c = 1.0 - u;
  if (c <= 0.0) return 0.0;
  float a2 = alpha * alpha;
  float d = a2 * c * c + u * (2.0 - u);
  return a2 / (pi * d * d);
}
#endif

// D(h) dh = D_base(h') dh' with p(h') = mean + A (p(h) - mean), which preserves the energy of the base lobe.
float partDensity(Part part, Direction at) {
#if ANISOTROPIC_LOBE
  if (part.scale <= 0.0) return 0.0;
  vec2 p = part.mean + part.shrink * (at.p - part.mean);
  float metric = 1.0 + dot(p, p);
  float ratio = at.metric / metric;
  return part.scale * ratio * ratio * baseDensity(part.lobe, part.axis, vec3(2.0 * p, 2.0 - metric) / metric);
#else
  countLobes(1);
  vec2 d = at.p - part.mean;
  d = vec2(dot(part.shrink.xy, d), dot(part.shrink.yz, d));
  vec2 p = part.mean + d;
  float metric = 1.0 + dot(p, p);
  float ratio = at.metric / metric;
  return part.scale * ratio * ratio * lobeAt(part.lobe, 2.0 * dot(d, d) / (metric * part.metric));
#endif
}
