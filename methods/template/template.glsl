// One lobe about the mean normal, as wide as a facet's lobe and the expected spread together. Slope variances of
// independent spreads add.
#include "facets_module.glsl"

Effective effective(Footprints f) {
#if NORMAL_VARIATION
  vec4 texel = fetch(template_normal, f.normal);  // mean normal, spread
  float size = length(texel.xyz);
  vec3 normal = size > 1e-6 ? texel.xyz / size : vec3(0.0, 0.0, 1.0);
  return Effective(spreadFacets(normal, lobeVariance(template_lobe), option_share * texel.w));
#else
  return Effective(evenFacets(vec3(0.0, 0.0, 1.0), template_lobe));
#endif
}
