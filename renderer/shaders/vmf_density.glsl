// kappa / (2 pi (1 - e^{-2 kappa})) e^{kappa (n.h - 1)} (Xu 2017, equation 6, in the form that does not overflow).
float vmfDensity(float kappa, vec3 n, vec3 h) {
  float u = oneMinusDot(n, h);
  if (kappa < 1e-4) return (1.0 + kappa * (1.0 - u)) / (4.0 * pi);
  float mass = kappa < 0.01 ? 2.0 * kappa * (1.0 - kappa) : 1.0 - exp(-2.0 * kappa);
  return kappa / (2.0 * pi * mass) * exp(-kappa * u);
}
