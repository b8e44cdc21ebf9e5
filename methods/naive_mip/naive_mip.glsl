/*
name = "naive_mip"
summary = "Mip maps of normal and roughness: the mean normal, renormalised, and the mean roughness."
paper = "Williams 1983, Pyramidal Parametrics (the mip map itself)"
reads = ["mean_direction", "mean_roughness if averages_roughness", "mean_lobe if averages_lobe"]

[[option]]
name = "averages"
choices = ["roughness", "lobe"]
meaning = "What of a varying lobe is averaged: the perceptual roughness, as a texture stores it, or the lobe's own parameter (exponent, alpha, kappa), as Xu 2017 does."
*/
// One lobe about the renormalised mean normal, as wide as a facet of the mean roughness or the mean lobe parameter.
#include "mean_normal.glsl"
#if AVERAGES_ROUGHNESS
#include "mean_roughness.glsl"
#endif
#include "facets_module.glsl"

Effective effective(Footprints f) {
#if AVERAGES_ROUGHNESS
  float lobe = baseLobe(f);
#elif ROUGHNESS_VARIATION
  float lobe = fetch(mean_lobe, f.roughness).r;
#else
  float lobe = lobe_cutoff.x;
#endif
  return Effective(evenFacets(meanNormal(f).xyz, lobe));
}
