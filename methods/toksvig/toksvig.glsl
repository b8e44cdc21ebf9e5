/*
name = "toksvig"
summary = "One lobe about the mean normal, widened according to the length of the mean normal."
paper = "Toksvig 2005, Mipmapping Normal Maps, Journal of Graphics Tools 10(3)"
reads = ["mean_normal", "lobe_variance"]
leaves_out = ["anisotropic_lobe"]

[[option]]
name = "spread"
default = 1
range = [0, 4]
meaning = "Factor on the spread (1 - |Na|) / |Na| before it is added to the lobe's slope variance per axis; 1 is Toksvig's. Engines' recipes for alpha^2 differ: alpha^2 += 2 spread / kappa."

[[option]]
name = "diffuse"
choices = ["mean", "normalized"]
meaning = "The diffuse term's normal: the mean normal, whose dot product is the mean of the facets' own while all face the light, or the renormalised one."
*/
// Toksvig 2005: the mean of unit normals has length |Na| = 1 - slope variance + .... A Blinn-Phong lobe of exponent s over
// such normals is close to one of exponent s' = |Na| s / (|Na| + s (1 - |Na|)). As widths,
//   1 / s' = 1 / s + (1 - |Na|) / |Na|,
// is a sum of slope variances per axis and therefore applies to every distribution: 1 / s becomes alpha^2 / 2 for Beckmann
// and GGX (Walter 2007, section 5.2), and 1 / kappa for vMF.
#include "mean_normal.glsl"
#include "lobe_variance.glsl"

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
#if DIFFUSE && DIFFUSE_MEAN
  r.diffuse *= e.consistency;
#endif
  return r;
}

float ndf(Effective e, vec3 h) { return facetDensity(e.facets, h); }

#if LOBES_LISTED
#include "facet_normal_lobes.glsl"

vec3 meanNormal(Effective e) {
#if DIFFUSE_MEAN
  return e.facets.normal * e.consistency;
#else
  return e.facets.normal;
#endif
}
#endif
