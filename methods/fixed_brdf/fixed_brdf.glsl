/*
name = "fixed_brdf"
summary = "The finest level's reflectance at any distance, over geometry that is filtered."
paper = "Tan, Lin, Quan, Guo, Shum 2005, Multiresolution Reflectance Filtering, EGSR (its comparison, figure 8)"
reads = ["mean_direction", "finest_roughness"]
leaves_out = ["anisotropic_lobe", "normal_layers"]
*/
// Filters geometry but not reflectance: the renormalised mean normal with the lobe of the texel at the pixel's centre (Tan
// 2005, figure 8d).
#include "mean_normal.glsl"
#include "facets_module.glsl"

Effective effective(Footprints f) {
#if ROUGHNESS_VARIATION
  float lobe = lobeFromRoughness(fetchFinest(finest_roughness, f.roughness).r);
#else
  float lobe = lobe_cutoff.x;
#endif
  return Effective(evenFacets(meanNormal(f).xyz, lobe));
}
