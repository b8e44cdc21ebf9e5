// The best lobes of every texel of the mip chain, summed over the texels of the footprint. A lobe is the base lobe about
// an axis, widened by a slope variance, then stretched to a covariance over the stereographic plane.

struct Peak {
  vec3 axis;
  float deviation;  // of slopes; below 0: none over the footprint's own base lobe
  vec3 spread;      // xx, xy, yy over the plane
  float factor;     // of the weights of a texel
  float weight;
};

#if NORMAL_VARIATION
const int peaks = int(option_k);
#else
const int peaks = 1;
#endif

#include "summed_peaks.glsl"
const bool fast_density = false;
#include "stretched_part.glsl"

#if NORMAL_VARIATION
ivec2 peakMapSize() { return textureSize(best_lobes_first, 0).xy; }

Peak peakOf(FootprintTexel texel, int i) {
  vec4 stored = layerOf(best_lobes_first, best_lobes_rest, texel, i);
  vec4 spread = vec4(0.0);
  if (texel.level >= 0.5) spread = layerOf(best_lobes_first, best_lobes_rest, texel, peaks + i);
  // Texels without a fit have no factor.
  return Peak(directionFromDisc(stored.xy), stored.z, spread.xyz, spread.w > 0.0 ? spread.w : 1.0, stored.w);
}
#endif

vec3 meanOfNormals(Footprints f) {
#if NORMAL_VARIATION && DIFFUSE
  return fetch(best_lobes_mean, f.normal).xyz;
#else
  return vec3(0.0, 0.0, 1.0);
#endif
}

// Stereographic coordinates of an axis.
vec2 planeOf(vec3 axis) { return axis.xy / max(1.0 + axis.z, 1e-3); }

Peak upPeak() { return Peak(vec3(0.0, 0.0, 1.0), -1.0, vec3(0.0), 1.0, 1.0); }

// Where texels have base lobes of their own, a lobe is over the narrowest of the material and has the energy of its
// width. Elsewhere it has the energy of the base lobe.
Part partOf(Effective e, Peak peak) {
  float deviation = max(peak.deviation, 0.0);
#if NORMAL_VARIATION && ROUGHNESS_VARIATION
  if (best_lobes_joint > 0.5 && peak.deviation >= 0.0) {
    float own = best_lobes_narrowest + deviation * deviation;
    return stretchedPart(peak.factor, planeOf(peak.axis), peak.spread, lobeFromVariance(own), own);
  }
#endif
  float variance = e.variance + deviation * deviation;
  float width = lobeFromVariance(variance);
  float energy = lobeEnergy(lobeFromVariance(e.variance)) / lobeEnergy(width);
  return stretchedPart(energy, planeOf(peak.axis), peak.spread, width, variance);
}

float peakDensity(Effective e, Peak peak, vec3 h) { return partDensity(partOf(e, peak), directionOf(h)); }

// The geometry factor is that of single facets about the lobe's axis.
float peakReflectance(Effective e, Peak peak, vec3 h, vec3 wi, vec3 wo) {
  return peakDensity(e, peak, h) * geometryFactor(lobeFromVariance(e.variance), peak.axis, h, wi, wo);
}

#if LOBES_LISTED
NormalLobe peakNormalLobe(Effective e, Peak peak, int k, float share) {
  NormalLobe lobe = baseNormalLobe(peak.axis, lobeFromVariance(partOf(e, peak).breadth), share);
  lobe.base = lobeFromVariance(e.variance);
  return lobe;
}
#endif
