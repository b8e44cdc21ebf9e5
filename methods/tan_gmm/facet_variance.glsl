// The slope variance of a facet's lobe over a footprint. With specular=joint texels weigh by their specular colour.
#include "lobe_variance.glsl"

#if ROUGHNESS_VARIATION && SPECULAR_JOINT && SPECULAR_VARIATION
const float least_variance = 5e-7;  // of the smallest alpha of a material, 0.001; where all is black there is none

float facetVariance(Footprints f) {
  vec2 weighed = storedLobe(f).rg;
  return max(varianceOfStored(weighed.x / max(weighed.y, 1e-6)), least_variance);
}
#else
float facetVariance(Footprints f) { return baseVariance(f); }
#endif
