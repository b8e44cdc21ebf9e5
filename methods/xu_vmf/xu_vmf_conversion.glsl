// Converts a base lobe to the von Mises-Fisher lobe of the same width, whose characteristic vector r = |r| mu averages
// linearly (Xu 2017, section 3.2), and back. |r| is near 1 for narrow lobes, so functions compute q = 1 - |r|.
#include "vmf.glsl"

#if DISTRIBUTION_BLINN_PHONG
// Equation 14: the lobe with the same peak and the same energy over solid angle.
float kappaOfLobe(float s) { return s + 1.0; }
float lobeOfKappa(float kappa) { return clamp(kappa - 1.0, 0.0, largest_exponent); }
#else
float kappaOfLobe(float lobe) { return 1.0 / max(lobeVariance(lobe), 1e-12); }
float lobeOfKappa(float kappa) { return lobeFromVariance(1.0 / max(kappa, 1e-6)); }
#endif

// The energy of a base lobe over solid angle. It grows with the width of a microfacet lobe, but the mean of narrow
// lobes keeps their energy. Therefore a wide lobe that replaces narrow ones is scaled by the ratio.
float energyOf(float base) {
#if LOBE_BASE
  return lobeEnergy(base);
#else
  return 1.0;
#endif
}

#if CONVERSION_TABLE
// q = 1 - |r| of kappa from a table, as in the paper, but over the logarithm of kappa, and of q instead of |r|. (kappa
// from a table of |r| over kappa itself is off by a third for kappa of 1 to 10.)
const float table_first = 1e-2;  // of kappa
const float table_last = 1e5;

// The limits beyond the table: |r| = kappa / 3, and q = 1 / (kappa - 1/2).
float tabulatedShortfall(sampler2D table, float kappa) {
  if (kappa < table_first) return 1.0 - kappa / 3.0;
  if (kappa > table_last) return 1.0 / (kappa - 0.5);
  int last = textureSize(table, 0).x - 1;
  float position = log(kappa / table_first) / log(table_last / table_first) * float(last);
  int below = clamp(int(position), 0, last - 1);
  return mix(texelFetch(table, ivec2(below, 0), 0).r, texelFetch(table, ivec2(below + 1, 0), 0).r,
             position - float(below));
}
#elif CONVERSION_PUBLISHED
// q = 1 - |r| from the table that the paper describes: |r| over kappa.
float tabulatedShortfall(sampler2D table, float kappa) {
  int last = textureSize(table, 0).x - 1;
  float position = min(kappa, float(last));
  int below = clamp(int(position), 0, last - 1);
  return 1.0 - mix(texelFetch(table, ivec2(below, 0), 0).r, texelFetch(table, ivec2(below + 1, 0), 0).r,
                   position - float(below));
}
#endif
