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
//? include mean_normal.glsl
//? include mean_roughness.glsl if averages_roughness
//? include facets_module.glsl

Effective effective(Footprints f) {
  float lobe = baseLobe(f);                      //? if averages_roughness
  float lobe = fetch(mean_lobe, f.roughness).r;  //? elif roughness_variation
  float lobe = lobe_cutoff.x;                    //? else
  return Effective(evenFacets(meanNormal(f).xyz, lobe));
}
