// The slope variance of the base lobe over a footprint, from the texture of `bake_lobe_variance` if the roughness
// varies. Its name says what it stores, in units of stored_lobe_variance: variances or their reciprocals.
//? if roughness_variation
const float stored_lobe_variance = 1.0 / 64.0;  // its unit

// The inverse of stored_roughness.
float varianceOfStored(float stored) {
  return stored_lobe_variance / max(stored, 1e-6);  //? if lobe_concentration
  return stored * stored_lobe_variance;             //? else
}

// The stored value under a footprint, in the first channel.
vec4 storedLobe(Footprints f) {
  return fetch(lobe_concentration, f.roughness);  //? if lobe_concentration
  return fetch(lobe_variance, f.roughness);       //? else
}

float baseVariance(Footprints f) { return varianceOfStored(storedLobe(f).r); }
//? else
float baseVariance(Footprints f) { return lobeVariance(lobe_cutoff.x); }
//? end
