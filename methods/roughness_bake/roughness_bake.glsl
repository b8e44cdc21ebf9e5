// The mean normal under a lobe as wide as engines bake it into roughness mips.
#if ANISOTROPIC_ON && NORMAL_VARIATION
#include "anisotropic_roughness.glsl"
#else
#include "mean_normal.glsl"
#include "facets_module.glsl"
#include "baked_roughness.glsl"

Effective effective(Footprints f) {
  float variance = lobeVariance(baseLobe(f));
  float added = 0.5 * bakedAlpha2(f) - variance;
#if MULTI_LOBE
  added = max(added, 0.0);  // of a formula that may narrow: one of several lobes has no variance to spare
#endif
  return Effective(spreadFacets(meanNormal(f).xyz, variance, added));
}
#endif
