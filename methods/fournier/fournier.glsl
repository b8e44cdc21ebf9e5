// Fournier 1992: every texel of the mip chain stores Phong peaks fitted to its distribution of normals. Peaks of
// neighbouring texels are unrelated and cannot be blended. Therefore the peaks of all texels of the footprint are
// scaled by the texels' weights and summed for every light, 8 times as many as a texel has.
//? include lobe_variance.glsl

struct Effective {
  Footprint footprint;
  float variance;  // the base lobe's slope variance per axis
  vec3 mean;       // of the normals, for the diffuse term
  float total;     // under an environment: the weight of all peaks, below 1 if texels lack normals
};

//? if environment_light
float weightOfPeaks(Footprint f);
//? end

Effective effective(Footprints f) {
  Effective e;
  e.footprint = f.normal;
  e.mean = vec3(0.0, 0.0, 1.0);
//? if normal_variation and diffuse
  e.mean = fetch(fournier_mean, f.normal).xyz;
//? end
  e.variance = baseVariance(f);
//? if environment_light
  e.total = weightOfPeaks(f.normal);
//? else
  e.total = 1.0;
//? end
  return e;
}

//? if normal_variation
// Lambert's azimuthal equal-area map from the disc of radius 2 to the sphere.
vec3 directionFromDisc(vec2 p) {
  float quarter = min(0.25 * dot(p, p), 1.0);
  return vec3(p * sqrt(1.0 - quarter), 1.0 - 2.0 * quarter);
}

// A peak: axis on the disc, root of the spread, weight. The finest level has one peak per texel, so the other peaks
// start at the next level.
vec4 peakOf(FootprintTexel texel, int i) {
  if (i == 0) return fetchTexel(fournier_first, 0, texel);
  texel.level -= 1.0;
  return fetchTexel(fournier_rest, i - 1, texel);
}
//? end

float reflectedDensity(Facets facets, vec3 h, bool with_geometry, vec3 wi, vec3 wo) {
  return with_geometry ? facetReflectance(facets, h, wi, wo) : facetDensity(facets, h);
}

// The sum over all peaks of their densities at h, with or without their geometry factors.
float sumOfPeaks(Effective e, vec3 h, bool with_geometry, vec3 wi, vec3 wo) {
//? if normal_variation
  float sum = 0.0;
  float total = 0.0;  // below 1 if texels lack normals
  int texels = footprintTexelCount(fournier_first, e.footprint);
  int t = 0;
  do {
    FootprintTexel texel = footprintTexel(fournier_first, e.footprint, t);
    if (texel.weight <= 0.0) continue;
    int peaks = texel.level < 0.5 ? 1 : int(option_peaks);
    int i = 0;
    do {
      vec4 peak = peakOf(texel, i);
      if (peak.w <= 0.0) break;  // heaviest first: all others have no weight
      float weight = texel.weight * peak.w;
      Facets facets = spreadFacets(directionFromDisc(peak.xy), e.variance, peak.z * peak.z);
      sum += weight * reflectedDensity(facets, h, with_geometry, wi, wo);
      total += weight;
    } while (++i < peaks);
  } while (++t < texels);
  if (total > 0.0) return sum / total;
//? end
  return reflectedDensity(spreadFacets(vec3(0.0, 0.0, 1.0), e.variance, 0.0), h, with_geometry, wi, wo);
}

Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo) {
  Reflected r;
  r.specular = vec3(0.0);
  if (halfVectorIsDefined(wi, wo))
    r.specular = fresnelTerm(s.f0, wi, wo) * sumOfPeaks(e, halfVector(wi, wo), true, wi, wo);
//? if diffuse
  // The dot product with the mean normal is the mean over the facets while all of them face the light.
  float size = length(e.mean);
  vec3 n = size > 1e-6 ? e.mean / size : vec3(0.0, 0.0, 1.0);
  r.diffuse = diffuse(n, s, wi, wo) * min(size, 1.0);
//? end
  return r;
}

float ndf(Effective e, vec3 h) { return sumOfPeaks(e, h, false, h, h); }

//? if environment_light
Facets upFacets(Effective e) { return spreadFacets(vec3(0.0, 0.0, 1.0), e.variance, 0.0); }

//? if normal_variation
// Peak `number` of a texel, with weight 0 if the texel has fewer.
vec4 peakOrNone(FootprintTexel texel, int number) {
  bool there = texel.weight > 0.0 && (number == 0 || texel.level >= 0.5);
  return there ? peakOf(texel, number) : vec4(0.0);
}

float weightOfPeaks(Footprint f) {
  float total = 0.0;
  int texels = footprintTexelCount(fournier_first, f);
  int t = 0;
  do {
    FootprintTexel texel = footprintTexel(fournier_first, f, t);
    for (int i = 0; i < int(option_peaks); ++i) total += texel.weight * max(peakOrNone(texel, i).w, 0.0);
  } while (++t < texels);
  return total;
}

int lobeCount(Effective e) {
  if (e.total <= 0.0) return facetLobeCount();
  return facetLobeCount() * int(option_peaks) * footprintTexelCount(fournier_first, e.footprint);
}

NormalLobe normalLobe(Effective e, int i) {
  int k = i % facetLobeCount();
  if (e.total <= 0.0) return facetNormalLobe(upFacets(e), k, 1.0);
  int number = i / facetLobeCount();
  FootprintTexel texel = footprintTexel(fournier_first, e.footprint, number / int(option_peaks));
  vec4 peak = peakOrNone(texel, number % int(option_peaks));
  Facets facets = spreadFacets(directionFromDisc(peak.xy), e.variance, peak.z * peak.z);
  return facetNormalLobe(facets, k, texel.weight * max(peak.w, 0.0) / e.total);
}
//? else
float weightOfPeaks(Footprint f) { return 1.0; }
int lobeCount(Effective e) { return facetLobeCount(); }
NormalLobe normalLobe(Effective e, int i) { return facetNormalLobe(upFacets(e), i, 1.0); }
//? end

float lobeGeometry(Effective e, NormalLobe lobe, vec3 h, vec3 wi, vec3 wo) {
  return geometryFactor(lobe.base, lobe.normal, h, wi, wo);
}

vec3 meanNormal(Effective e) { return e.mean; }
//? end
