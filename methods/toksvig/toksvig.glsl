// Toksvig 2005: the mean of unit normals has length |Na| = 1 - variance + ..., and a Blinn-Phong lobe of exponent s over
// such normals is close to one of exponent s' = |Na| s / (|Na| + s (1 - |Na|)). The same said of widths,
//   1 / s' = 1 / s + (1 - |Na|) / |Na|,
// is a sum of slope variances per axis, which serves every distribution: alpha^2 / 2 takes the place of 1 / s for
// Beckmann and GGX (Walter 2007, section 5.2), 1 / kappa for vMF.
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

Effective effective(Footprints f) {
  Effective e;
//? if normal_variation
  vec3 mean = fetch(toksvig_normal, f.normal).xyz;
//? if storage_unorm8
  mean = 2.0 * mean - 1.0;
//? end
  float size = length(mean);
  e.consistency = min(size, 1.0);  // rounding of the storage leaves |Na| > 1 on flat maps: a negative variance
  vec3 normal = size > 1e-6 ? mean / size : vec3(0.0, 0.0, 1.0);
  float spread = option_spread * (1.0 - e.consistency) / max(e.consistency, 1e-6);
//? else
  e.consistency = 1.0;
  vec3 normal = vec3(0.0, 0.0, 1.0);
  float spread = 0.0;
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

//? if environment_light
//? include facet_normal_lobes.glsl

vec3 meanNormal(Effective e) {
//? if diffuse_mean
  return e.facets.normal * e.consistency;
//? else
  return e.facets.normal;
//? end
}
//? end
