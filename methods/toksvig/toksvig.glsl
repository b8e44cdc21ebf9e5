// Toksvig 2005: the mean of unit normals has length |Na| = 1 - variance + ..., and a Blinn-Phong lobe of exponent s over
// such normals is close to one of exponent s' = |Na| s / (|Na| + s (1 - |Na|)). The same said of widths,
//   1 / s' = 1 / s + (1 - |Na|) / |Na|,
// is a sum of slope variances per axis, which serves every distribution: alpha^2 / 2 takes the place of 1 / s for
// Beckmann and GGX (Walter 2007, section 5.2), 1 / kappa for vMF.
//? if normal_layers
//? include normal_layers.glsl
//? end
struct Effective {
  Facets facets;
  float consistency;  // |Na|, 1 where all normals agree
};

float baseVariance(Footprints f) {
//? if roughness_variation
  float deviation = fetch(toksvig_deviation, f.roughness).r;
  return deviation * deviation;
//? else
  return lobeVariance(lobe_cutoff.x);
//? end
}

// What a stored mean normal tells: its direction, and |Na|.
struct MeanNormal {
  vec3 direction;
  float consistency;
};

MeanNormal meanNormal(vec3 mean) {
//? if storage_unorm8
  mean = 2.0 * mean - 1.0;
//? end
  float size = length(mean);
  // Rounding of the storage leaves |Na| > 1 on flat maps: a negative variance.
  return MeanNormal(size > 1e-6 ? mean / size : vec3(0.0, 0.0, 1.0), min(size, 1.0));
}

float spreadOf(float consistency) { return option_spread * (1.0 - consistency) / max(consistency, 1e-6); }

Effective effective(Footprints f) {
  Effective e;
  e.consistency = 1.0;
  vec3 normal = vec3(0.0, 0.0, 1.0);
  float spread = 0.0;
//? if normal_variation
  MeanNormal own = meanNormal(fetch(toksvig_normal, f.normal).xyz);
  normal = own.direction;
  e.consistency = own.consistency;
  spread = spreadOf(own.consistency);
//? end
//? if normal_layers
  // The spread is a slope variance per axis: those of independent layers add.
  MeanNormal layer = meanNormal(fetch(toksvig_layer, f.layer).xyz);
  normal = withSlopesAdded(normal, layer.direction);
  e.consistency *= layer.consistency;
  spread += spreadOf(layer.consistency);
//? end
  e.facets = spreadFacets(normal, baseVariance(f), spread);
  return e;
}

vec3 specular(Effective e, vec3 f0, vec3 wi, vec3 wo) { return facetSpecular(e.facets, f0, wi, wo); }

//? if diffuse
vec3 diffuse(Effective e, vec3 albedo, vec3 f0, vec3 wi, vec3 wo) {
  vec3 reflected = lambert(e.facets.normal, albedo, f0, wi, wo);
//? if diffuse_mean
  reflected *= e.consistency;
//? end
  return reflected;
}
//? end

float ndf(Effective e, vec3 h) { return facetDensity(e.facets, h); }
