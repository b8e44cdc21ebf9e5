// Toksvig 2005: the mean of unit normals has length |Na| = 1 - slope variance + .... A Blinn-Phong lobe of exponent s over
// such normals is close to one of exponent s' = |Na| s / (|Na| + s (1 - |Na|)). As widths,
//   1 / s' = 1 / s + (1 - |Na|) / |Na|,
// is a sum of slope variances per axis and therefore applies to every distribution: 1 / s becomes alpha^2 / 2 for Beckmann
// and GGX (Walter 2007, section 5.2), and 1 / kappa for vMF.
//? include mean_normal.glsl
//? include lobe_variance.glsl

struct Effective {
  Facets facets;
  float consistency;  // |Na|, 1 where all normals agree
};

Effective effective(Footprints f) {
  vec4 mean = meanNormal(f);
  float spread = option_spread * (1.0 - mean.w) / max(mean.w, 1e-6);
  return Effective(spreadFacets(mean.xyz, baseVariance(f), spread), mean.w);
}

Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo) {
  Reflected r = facetShade(e.facets, s, wi, wo);
//? if diffuse and diffuse_mean
  r.diffuse *= e.consistency;
//? end
  return r;
}

float ndf(Effective e, vec3 h) { return facetDensity(e.facets, h); }

//? if lobes_listed
//? include facet_normal_lobes.glsl

vec3 meanNormal(Effective e) {
//? if diffuse_mean
  return e.facets.normal * e.consistency;
//? else
  return e.facets.normal;
//? end
}
//? end
