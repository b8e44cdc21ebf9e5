// Fournier 1992: every texel stores Phong peaks fitted to its normals, summed over the footprint's eight texels.

struct Peak {
  vec2 on_disc;     // axis
  float deviation;  // root of the spread
  float weight;
};

#if NORMAL_VARIATION
const int peaks = int(option_peaks);
#else
const int peaks = 1;
#endif

#include "summed_peaks.glsl"

#if NORMAL_VARIATION
ivec2 peakMapSize() { return textureSize(fournier_first, 0).xy; }

Peak peakOf(FootprintTexel texel, int i) {
  vec4 stored = layerOf(fournier_first, fournier_rest, texel, i);
  return Peak(stored.xy, stored.z, stored.w);
}
#endif

vec3 meanOfNormals(Footprints f) {
#if NORMAL_VARIATION && DIFFUSE
  return fetch(fournier_mean, f.normal).xyz;
#else
  return vec3(0.0, 0.0, 1.0);
#endif
}

Peak upPeak() { return Peak(vec2(0.0), 0.0, 1.0); }

Facets facetsOf(Effective e, Peak peak) {
  return spreadFacets(directionFromDisc(peak.on_disc), e.variance, peak.deviation * peak.deviation);
}

float peakDensity(Effective e, Peak peak, vec3 h) { return facetDensity(facetsOf(e, peak), h); }

float peakReflectance(Effective e, Peak peak, vec3 h, vec3 wi, vec3 wo) {
  return facetReflectance(facetsOf(e, peak), h, wi, wo);
}

#if LOBES_LISTED
NormalLobe peakNormalLobe(Effective e, Peak peak, int k, float share) {
  return facetNormalLobe(facetsOf(e, peak), k, share);
}
#endif
