// A von Mises-Fisher lobe as the characteristic vector r = |r| mu, which averages linearly (Xu 2017, section 3.2), and
// the base lobe of the same width. |r| is near 1 for narrow lobes: what is computed is q = 1 - |r|, which keeps its digits.

// q of kappa: the root in (0, 1] of q^3 + (kappa - 3) q^2 - 2 kappa q + 2 = 0, which is equation 9 in q, by two steps
// of Newton. The closed form with an arc cosine has lost kappa = 1000 in 32 bits.
float shortfallOf(float kappa) {
  float q = kappa >= 1.0 ? 1.0 / (kappa + 0.5) : 1.0 / (1.0 + kappa / 3.0);
  for (int i = 0; i < 2; ++i) {
    float value = ((q + (kappa - 3.0)) * q - 2.0 * kappa) * q + 2.0;
    q -= value / ((3.0 * q + 2.0 * (kappa - 3.0)) * q - 2.0 * kappa);
  }
  return q;
}

// Equation 8 (Banerjee et al. 2005), kappa = (3 |r| - |r|^3) / (1 - |r|^2), in q. 0 < q <= 1.
float kappaOf(float q) { return (1.0 - q) * (2.0 + q * (2.0 - q)) / (q * (2.0 - q)); }

//? if distribution_blinn_phong
// Equation 14: the lobe of the same peak and of the same energy over solid angle.
float kappaOfLobe(float s) { return s + 1.0; }
float lobeOfKappa(float kappa) { return clamp(kappa - 1.0, 0.0, largest_exponent); }
//? else
float kappaOfLobe(float lobe) { return 1.0 / max(lobeVariance(lobe), 1e-12); }
float lobeOfKappa(float kappa) { return lobeFromVariance(1.0 / max(kappa, 1e-6)); }
//? end
