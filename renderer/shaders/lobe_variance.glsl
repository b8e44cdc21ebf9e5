// The slope variance of the base lobe over a footprint, from the texture of `bake_lobe_variance` if the roughness
// varies.
//? if roughness_variation
const float stored_lobe_variance = 1.0 / 64.0;  // its unit

float baseVariance(Footprints f) {
//? if roughness_mean_concentration
  return stored_lobe_variance / max(fetch(lobe_variance, f.roughness).r, 1e-6);
//? else
  return fetch(lobe_variance, f.roughness).r * stored_lobe_variance;
//? end
}
//? else
float baseVariance(Footprints f) { return lobeVariance(lobe_cutoff.x); }
//? end
