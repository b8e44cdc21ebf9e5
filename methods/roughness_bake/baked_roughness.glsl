// Engines' roughness mips: the twin of presets.hpp, which derives the stable forms. A texture stores the spread of the
// normals only, so that one formula also serves maps with other coordinates. The base roughness is the mean of the
// roughness map, as in importers. The option that shaders call `bake` selects the formula.
#include "mean_roughness.glsl"
#if BAKE_KARIS
#include "vmf.glsl"
#endif

#if BAKE_FIT
// c(alpha), presets.cpp.
float fitConstant(float alpha) {
#if DISTRIBUTION_BLINN_PHONG
  const float table[11] = float[](2.200, 2.300, 2.335, 2.510, 2.825, 2.940, 3.120, 3.355, 3.635, 3.950, 4.000);
#elif DISTRIBUTION_BECKMANN
  const float table[11] = float[](2.155, 2.215, 2.225, 2.165, 2.020, 1.795, 1.470, 1.030, 0.450, 0.000, 0.000);
#elif DISTRIBUTION_GGX
  const float table[11] = float[](2.015, 2.245, 2.330, 2.250, 2.010, 1.615, 1.085, 0.410, 0.000, 0.000, 0.000);
#else
  const float table[11] = float[](2.080, 2.135, 2.135, 2.115, 2.085, 2.050, 2.020, 1.995, 2.000, 2.040, 2.125);
#endif
  float at = 10.0 * clamp(alpha, 0.0, 1.0);
  int i = min(int(at), 9);
  return mix(table[i], table[i + 1], at - float(i));
}
#endif

#if BAKE_KARIS || BAKE_CHAN2018
// 1 minus the product of two mean lengths, each given by 1 minus the length.
float joined(float a, float b) { return a + b - a * b; }
#endif

#if BAKE_CHAN2018
float ggxShortfall(float alpha2) {
  float a2 = max(1.0 - alpha2, 0.0);
  if (a2 < 0.01) return 1.0 / 3.0 - a2 * (2.0 / 15.0 + a2 * (2.0 / 35.0));
  float a = sqrt(a2);
  return alpha2 * (log((1.0 + a) / sqrt(alpha2)) - a) / (a2 * a);
}

float chan(float alpha2, float q) {
  const float least = 2.0 / (1.0 + 262144.0);
  float wanted = joined(ggxShortfall(clamp(alpha2, least, 1.0)), q);
  float low = sqrt(least);
  float high = 1.0;
  for (int i = 0; i < 20; ++i) {
    float middle = 0.5 * (low + high);
    if (ggxShortfall(middle * middle) < wanted) low = middle;
    else high = middle;
  }
  return 0.25 * (low + high) * (low + high);
}
#endif

// alpha'^2 of alpha^2, which is twice the lobe's slope variance, over normals of the stored spread.
float widened(float alpha2, float stored) {
#if BAKE_FIT
  return alpha2 + fitConstant(sqrt(alpha2)) * stored;
#elif BAKE_FILAMENT || BAKE_MJP_VMF
  return alpha2 + 2.0 * stored;
#elif BAKE_FILAMENT_RHO
  float alpha = sqrt(alpha2) + 2.0 * stored;
  return alpha * alpha;
#elif BAKE_UNITY
  return alpha2 + min(0.5 * stored, 0.04);
#elif BAKE_UNITY_PROJECTED
  if (alpha2 >= 0.5) return 0.5;
  float rest = 1.0 - alpha2;
  float added = min(0.5 * stored, 0.04);
  return min(alpha2 + rest * rest * added / (1.0 + rest * added), 0.5);
#elif BAKE_HDRP_IMPORT
  return alpha2 + min(0.5 * stored, 0.0625);
#elif BAKE_UNREAL
  float added = 2.0 * max(stored - 4e-5, 0.0) * max(1.0 - alpha2, 0.0);
  return (alpha2 + added) / (1.0 + added);
#elif BAKE_GODOT
  float alpha = sqrt(alpha2) + min(0.75 * stored, 0.16);
  return alpha * alpha;
#elif BAKE_THREE_REMOVED
  return alpha2 + 0.56 * stored;
#elif BAKE_KARIS
  float kappa = 2.0 / alpha2;
  float own = kappa > 20.0 ? 1.0 / kappa : 1.0 - meanCosine(kappa);  // coth kappa is 1 there
  float q = min(joined(own, stored), 1.0 - 1e-6);
  return 2.0 / max(kappaOf(q), 1e-6);
#elif BAKE_ORDER1886
  return alpha2 + stored;
#elif BAKE_CHAN2018
  return chan(alpha2, stored);
#else
  return alpha2 + min(option_bake_constant * stored, option_bake_cap);
#endif
}

// The stored spread over the footprint; spreads of independent layers add.
float storedSpread(Footprints f) {
  float stored = 0.0;
#if NORMAL_VARIATION
  stored = fetch(normal_spread, f.normal).r;
#endif
#if NORMAL_LAYERS
  float layer = fetch(layer_spread, f.layer).r;
#if BAKE_KARIS || BAKE_CHAN2018
  stored = joined(stored, layer);
#else
  stored += layer;
#endif
#endif
  return stored;
}

// alpha'^2 over the footprint.
float bakedAlpha2(Footprints f) { return widened(2.0 * lobeVariance(baseLobe(f)), storedSpread(f)); }
