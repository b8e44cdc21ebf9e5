// The normal distributions as densities over solid angle; the projected area of microfacet distributions integrates to
// one. The lobe parameter is the exponent (blinn_phong), alpha (beckmann, ggx) or kappa (vmf). lobeEnergy is the plain
// integral.
const float pi = 3.14159265358979;

// The narrowest lobe: its peak is finite in 32 bits, also times 1e3 of light.
const float smallest_alpha = 1e-3;
const float largest_exponent = 2e6;  // 2 / smallest_alpha^2

// log(1 - u) for u in [0, 1), with a relative error of 1e-7 and without the cancellation of log near 1. It has no
// branch, because software renderers execute both sides.
// 1 - u = 2^k (1 + f) with f from sqrt(1/2) - 1 to sqrt(2) - 1; for k = 0, f is exactly -u. The polynomial is minimax
// for the relative error of log(1 + f), 3e-8.
float log1m(float u) {
  const int root_half = 0x3f3504f3;
  int bits = floatBitsToInt(1.0 - u) - root_half;
  int k = bits >> 23;
  float f = k == 0 ? -u : intBitsToFloat((bits & 0x7fffff) + root_half) - 1.0;
  float tail = 0.333339107 + f * (-0.25001337 + f * (0.199630637 + f * (-0.165775848 + f * (0.149147693 +
               f * (-0.14267486 + f * 0.0870042989)))));
  return float(k) * 0.693147181 + (f + f * f * (f * tail - 0.5));
}

// 1 - n.h from the difference of the vectors, where the dot product cancels in 32 bits.
float oneMinusDot(vec3 n, vec3 h) {
  vec3 d = h - n;
  return 0.5 * dot(d, d);
}

#if DISTRIBUTION_BLINN_PHONG
// (s + 1) / (2 pi) (n.h)^s: unit energy over solid angle.
float lobeDensity(float s, vec3 n, vec3 h) {
  countLobes(1);
  float u = oneMinusDot(n, h);
  if (u >= 1.0) return 0.0;
  return (s + 1.0) / (2.0 * pi) * exp(s * log1m(u));
}
// Walter 2007, section 5.2.
float lobeFromAlpha(float alpha) { return 2.0 / max(alpha * alpha, smallest_alpha * smallest_alpha) - 2.0; }
float lobeVariance(float s) { return 1.0 / max(s, 1e-6); }
float lobeFromVariance(float variance) { return min(1.0 / max(variance, 1e-12), largest_exponent); }
float lobeAlpha(float s) { return sqrt(2.0 / (s + 2.0)); }
float lobeEnergy(float s) { return 1.0; }
#endif

#if DISTRIBUTION_VMF
#include "vmf.glsl"
float lobeDensity(float kappa, vec3 n, vec3 h) {
  countLobes(1);
  return vmfDensity(kappa, n, h);
}
float lobeFromAlpha(float alpha) { return 2.0 / max(alpha * alpha, smallest_alpha * smallest_alpha); }
float lobeVariance(float kappa) { return 1.0 / max(kappa, 1e-6); }
float lobeFromVariance(float variance) { return min(1.0 / max(variance, 1e-12), largest_exponent); }
float lobeAlpha(float kappa) { return min(sqrt(2.0 / max(kappa, 1e-6)), 1.0); }
float lobeEnergy(float kappa) { return 1.0; }
#endif

#if DISTRIBUTION_BECKMANN
// e^{-tan^2 / alpha^2} / (pi alpha^2 cos^4) (Beckmann 1963; Walter 2007, equation 25).
float lobeDensity(float alpha, vec3 n, vec3 h) {
  countLobes(1);
  float c = dot(n, h);
  if (c <= 1e-3) return 0.0;  // tan overflows, and the exponential has long been zero
  vec3 s = cross(n, h);       // |s| = sin, exact where 1 - c^2 cancels
  float c2 = c * c;
  float a2 = alpha * alpha;
  return exp(-dot(s, s) / (c2 * a2)) / (pi * a2 * c2 * c2);
}
float lobeFromAlpha(float alpha) { return max(alpha, smallest_alpha); }
float lobeVariance(float alpha) { return 0.5 * alpha * alpha; }
float lobeFromVariance(float variance) { return max(sqrt(2.0 * variance), smallest_alpha); }
float lobeAlpha(float alpha) { return alpha; }
// int sqrt(1 + alpha^2 t) e^-t dt = 1 + sqrt(pi) / 2 alpha e^(x^2) erfc(x), x = 1 / alpha. Abramowitz and Stegun 7.1.13
// bound it by this form, with c = 2 (exact for narrow lobes) and c = 4 / pi (exact for wide ones). The fitted c has an
// error below 5e-4.
float lobeEnergy(float alpha) {
  float a2 = alpha * alpha;
  float side = 1.0 + 1.588 * alpha;
  float c = (2.0 * side + 2.492 * a2) / (side + 1.957 * a2);
  return 1.0 + a2 / (1.0 + sqrt(1.0 + c * a2));
}
#endif

#if DISTRIBUTION_GGX
#include "ggx_density.glsl"
float lobeDensity(float alpha, vec3 n, vec3 h) {
  countLobes(1);
  return ggxDensity(alpha * alpha, n, h);
}
float lobeFromAlpha(float alpha) { return max(alpha, smallest_alpha); }
float lobeVariance(float alpha) { return 0.5 * alpha * alpha; }
float lobeFromVariance(float variance) { return clamp(sqrt(2.0 * variance), smallest_alpha, 1.0); }
float lobeAlpha(float alpha) { return alpha; }
// 1 + alpha^2 atanh(t) / t with t = sqrt(1 - alpha^2); atanh(t) / t = 1 + t^2 / 3 + ... for small t.
float lobeEnergy(float alpha) {
  float a2 = alpha * alpha;
  float t = sqrt(max(1.0 - a2, 0.0));
  float ratio = t < 0.03 ? 1.0 + t * t / 3.0 : log((1.0 + t) / alpha) / t;
  return 1.0 + a2 * ratio;
}
#endif

// glTF 2.0, appendix B: alpha is the square of the perceptual roughness.
float lobeFromRoughness(float roughness) { return lobeFromAlpha(roughness * roughness); }
