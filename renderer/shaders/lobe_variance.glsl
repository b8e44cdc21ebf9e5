// The slope variance of the base lobe over a footprint, from the texture of `bake_lobe_variance` if the roughness
// varies.
//? if roughness_variation
const float stored_lobe_variance = 1.0 / 64.0;  // its unit

// The inverse of stored_roughness.
float varianceOfStored(float stored) {
  return stored_lobe_variance / max(stored, 1e-6);  //? if roughness_mean_concentration
  return stored * stored_lobe_variance;             //? else
}

float baseVariance(Footprints f) { return varianceOfStored(fetch(lobe_variance, f.roughness).r); }
//? else
float baseVariance(Footprints f) { return lobeVariance(lobe_cutoff.x); }
//? end
