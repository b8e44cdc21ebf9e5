// One lobe about the renormalised mean normal, as wide as a facet of the mean roughness or the mean lobe parameter.
//? include mean_normal.glsl
//? include facets_module.glsl

Effective effective(Footprints f) {
//? if roughness_variation and averages_lobe
  float lobe = fetch(naive_lobe, f.roughness).r;
//? elif roughness_variation
  float lobe = lobeFromRoughness(fetch(naive_roughness, f.roughness).r);
//? else
  float lobe = lobe_cutoff.x;
//? end
  return Effective(evenFacets(meanNormal(f).xyz, lobe));
}
