// The von Mises-Fisher distribution of unit vectors h about an axis, with density proportional to e^{kappa (axis.h)},
// and its Gaussian in the tangent plane at the axis. Matches renderer/lobes/lobe.hpp.

// 1 - e^{-2 x} for x >= 0, by a series where the difference cancels.
float oneMinusExp2(float x) { return x < 0.02 ? 2.0 * x * (1.0 - x * (1.0 - x * (2.0 / 3.0 - x / 3.0))) : 1.0 - exp(-2.0 * x); }

// kappa / (2 pi (1 - e^{-2 kappa})) e^{kappa (n.h - 1)} (Xu 2017, equation 6, in a form without overflow).
float vmfDensity(float kappa, vec3 n, vec3 h) {
  float u = oneMinusDot(n, h);
  if (kappa < 1e-4) return (1.0 + kappa * (1.0 - u)) / (4.0 * pi);
  return kappa / (2.0 * pi * oneMinusExp2(kappa)) * exp(-kappa * u);
}

// The mean of axis.h, the mean resultant length |r| = coth kappa - 1 / kappa; a series where both terms nearly cancel.
float meanCosine(float kappa) {
  float k2 = kappa * kappa;
  if (kappa < 0.5) return kappa * (1.0 / 3.0 - k2 * (1.0 / 45.0 - k2 * (2.0 / 945.0 - k2 / 4725.0)));
  float e = exp(-2.0 * kappa);
  return (1.0 + e) / (1.0 - e) - 1.0 / kappa;
}

// kappa = (3 |r| - |r|^3) / (1 - |r|^2) from q = 1 - |r|, 0 < q <= 1 (Banerjee et al. 2005; Xu 2017, equation 8).
float kappaOf(float q) { return (1.0 - q) * (2.0 + q * (2.0 - q)) / (q * (2.0 - q)); }

// The inverse: the root in (0, 1] of q^3 + (kappa - 3) q^2 - 2 kappa q + 2 = 0 (Xu 2017, equation 9, in q), by two
// Newton steps. The closed form with an arc cosine fails at kappa = 1000 in 32 bits.
float shortfallOf(float kappa) {
  float q = kappa >= 1.0 ? 1.0 / (kappa + 0.5) : 1.0 / (1.0 + kappa / 3.0);
  for (int i = 0; i < 2; ++i) {
    float value = ((q + (kappa - 3.0)) * q - 2.0 * kappa) * q + 2.0;
    q -= value / ((3.0 * q + 2.0 * (kappa - 3.0)) * q - 2.0 * kappa);
  }
  return q;
}

// The normal distribution function, to 1.4e-4 (Page 1977), and its density at 0.
const float inverse_root_two_pi = 0.3989423;
float normalCdf(float x) {
  float z = clamp(x, -8.0, 8.0);
  return 1.0 / (1.0 + exp(-z * (1.5976 + 0.070565992 * z * z)));
}
