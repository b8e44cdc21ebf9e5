// The slope variance of the base lobe over a footprint, from the texture of `bake_lobe_variance` if the roughness
// varies. Its name says what it stores, in units of stored_lobe_variance: variances or their reciprocals.
#if ROUGHNESS_VARIATION
const float stored_lobe_variance = 1.0 / 64.0;  // its unit

// The inverse of stored_roughness.
float varianceOfStored(float stored) {
#if LOBE_CONCENTRATION
  return stored_lobe_variance / max(stored, 1e-6);
#else
  return stored * stored_lobe_variance;
#endif
}

// The stored value under a footprint, in the first channel.
vec4 storedLobe(Footprints f) {
#if LOBE_CONCENTRATION
  return fetch(lobe_concentration, f.roughness);
#else
  return fetch(lobe_variance, f.roughness);
#endif
}

float baseVariance(Footprints f) { return varianceOfStored(storedLobe(f).r); }
#else
float baseVariance(Footprints f) { return lobeVariance(lobe_cutoff.x); }
#endif
