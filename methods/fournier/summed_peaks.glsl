// Peaks of every texel of the mip chain, which cannot be blended with those of neighbouring texels. Therefore the peaks
// of all texels of the footprint are scaled by the texels' weights and summed for every light. Includers define `struct
// Peak` with a weight, `const int peaks` of a texel above the finest level, and the functions below.
#include "lobe_variance.glsl"

struct Effective {
  Footprint footprint;
  float variance;  // the base lobe's slope variance per axis
  vec3 mean;       // of the normals, for the diffuse term
  float total;     // under an environment: the weight of all peaks, below 1 if texels lack normals
};

#if NORMAL_VARIATION
ivec2 peakMapSize();                       // of the finest level
Peak peakOf(FootprintTexel texel, int i);  // heaviest first

// Layer i of a texel. The finest level has the first one only, so the others start at the next level.
vec4 layerOf(sampler2DArray first, sampler2DArray rest, FootprintTexel texel, int i) {
  if (i == 0) return fetchTexel(first, 0, texel);
  texel.level -= 1.0;
  return fetchTexel(rest, i - 1, texel);
}
#endif
vec3 meanOfNormals(Footprints f);
Peak upPeak();  // the surface's own normal, with weight 1
float peakDensity(Effective e, Peak peak, vec3 h);
float peakReflectance(Effective e, Peak peak, vec3 h, vec3 wi, vec3 wo);  // with the geometry factor

// Lambert's azimuthal equal-area map from the disc of radius 2 to the sphere.
vec3 directionFromDisc(vec2 p) {
  float quarter = min(0.25 * dot(p, p), 1.0);
  return vec3(p * sqrt(1.0 - quarter), 1.0 - 2.0 * quarter);
}

#if LOBES_LISTED
float weightOfPeaks(Footprint f);
#endif

Effective effective(Footprints f) {
  Effective e;
  e.footprint = f.normal;
  e.mean = meanOfNormals(f);
  e.variance = baseVariance(f);
#if LOBES_LISTED
  e.total = weightOfPeaks(f.normal);
#else
  e.total = 1.0;
#endif
  return e;
}

float reflectedByPeak(Effective e, Peak peak, vec3 h, bool with_geometry, vec3 wi, vec3 wo) {
  return with_geometry ? peakReflectance(e, peak, h, wi, wo) : peakDensity(e, peak, h);
}

// The sum over all peaks of their densities at h, with or without their geometry factors.
float sumOfPeaks(Effective e, vec3 h, bool with_geometry, vec3 wi, vec3 wo) {
#if NORMAL_VARIATION
  float sum = 0.0;
  float total = 0.0;  // below 1 if texels lack normals
  ivec2 finest = peakMapSize();
  int texels = footprintTexelCount(finest, e.footprint);
  int t = 0;
  do {
    FootprintTexel texel = footprintTexel(finest, e.footprint, t);
    if (texel.weight <= 0.0) continue;
    int here = texel.level < 0.5 ? 1 : peaks;
    int i = 0;
    do {
      Peak peak = peakOf(texel, i);
      if (peak.weight <= 0.0) break;  // heaviest first: all others have no weight
      float weight = texel.weight * peak.weight;
      sum += weight * reflectedByPeak(e, peak, h, with_geometry, wi, wo);
      total += weight;
    } while (++i < here);
  } while (++t < texels);
  if (total > 0.0) return sum / total;
#endif
  return reflectedByPeak(e, upPeak(), h, with_geometry, wi, wo);
}

Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo) {
  Reflected r;
  r.specular = vec3(0.0);
  if (halfVectorIsDefined(wi, wo))
    r.specular = fresnelTerm(s.f0, wi, wo) * sumOfPeaks(e, halfVector(wi, wo), true, wi, wo);
#if DIFFUSE
  // The dot product with the mean normal is the mean over the facets while all of them face the light.
  float size = length(e.mean);
  vec3 n = size > 1e-6 ? e.mean / size : vec3(0.0, 0.0, 1.0);
  r.diffuse = diffuse(n, s, wi, wo) * min(size, 1.0);
#endif
  return r;
}

float ndf(Effective e, vec3 h) { return sumOfPeaks(e, h, false, h, h); }

#if LOBES_LISTED
NormalLobe peakNormalLobe(Effective e, Peak peak, int k, float share);  // of the base BRDF's lobe k

#if NORMAL_VARIATION
float weightOfPeaks(Footprint f) {
  float total = 0.0;
  ivec2 finest = peakMapSize();
  int texels = footprintTexelCount(finest, f);
  int t = 0;
  do {
    FootprintTexel texel = footprintTexel(finest, f, t);
    for (int i = 0; i < peaks; ++i) {
      bool there = texel.weight > 0.0 && (i == 0 || texel.level >= 0.5);
      if (there) total += texel.weight * max(peakOf(texel, i).weight, 0.0);
    }
  } while (++t < texels);
  return total;
}

int lobeCount(Effective e) {
  if (e.total <= 0.0) return facetLobeCount();
  return facetLobeCount() * peaks * footprintTexelCount(peakMapSize(), e.footprint);
}

NormalLobe normalLobe(Effective e, int i) {
  int k = i % facetLobeCount();
  if (e.total <= 0.0) return peakNormalLobe(e, upPeak(), k, 1.0);
  int number = i / facetLobeCount();
  FootprintTexel texel = footprintTexel(peakMapSize(), e.footprint, number / peaks);
  bool there = texel.weight > 0.0 && (number % peaks == 0 || texel.level >= 0.5);
  Peak peak = upPeak();
  if (there) peak = peakOf(texel, number % peaks);
  return peakNormalLobe(e, peak, k, there ? texel.weight * max(peak.weight, 0.0) / e.total : 0.0);
}
#else
float weightOfPeaks(Footprint f) { return 1.0; }
int lobeCount(Effective e) { return facetLobeCount(); }
NormalLobe normalLobe(Effective e, int i) { return peakNormalLobe(e, upPeak(), i, 1.0); }
#endif

float lobeGeometry(Effective e, NormalLobe lobe, vec3 h, vec3 wi, vec3 wo) {
  return geometryFactor(lobe.base, lobe.normal, h, wi, wo);
}

vec3 meanNormal(Effective e) { return e.mean; }
#endif
