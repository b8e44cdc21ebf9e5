// Filters geometry but not reflectance: the renormalised mean normal with the lobe of the texel at the pixel's centre (Tan
// 2005, figure 8d).
//? include mean_normal.glsl
//? include facets_module.glsl

Effective effective(Footprints f) {
//? if roughness_variation
  float lobe = lobeFromRoughness(fetchFinest(fixed_roughness, f.roughness).r);
//? else
  float lobe = lobe_cutoff.x;
//? end
  return Effective(evenFacets(meanNormal(f).xyz, lobe));
}
