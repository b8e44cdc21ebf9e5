// The base lobe's slope variance over a footprint, from the texture of `bake_lobe_variance` where the roughness varies.
//? if roughness_variation
const float stored_lobe_variance = 1.0 / 64.0;  // its unit
float baseVariance(Footprints f) { return fetch(lobe_variance, f.roughness).r * stored_lobe_variance; }
//? else
float baseVariance(Footprints f) { return lobeVariance(lobe_cutoff.x); }
//? end
