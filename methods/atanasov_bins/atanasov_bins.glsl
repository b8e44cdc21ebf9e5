// Atanasov et al. 2020: counts the normals under a pixel by bins of the half vector. The density of normals at h is the
// area of the footprint's texels with normals in h's bin, divided by the area of the footprint and the solid angle of
// the bin. If texels reflect by a lobe, it is the mean of the lobes about the normals of the bins around h.
#include "direction_grid.glsl"
#if ROUGHNESS_LOBE || ROUGHNESS_BIN && SURFACE_MICROFACETS
#include "lobe_variance.glsl"
#endif

// The integers of the precompute, four bytes each: packed normals and their bins.

uint wordOf(vec4 bytes) {
  uvec4 b = uvec4(bytes * 255.0 + 0.5);
  return b.x | b.y << 8 | b.z << 16 | b.w << 24;
}

// Word i of a list, in rows whose length is a power of two.
uint wordAt(sampler2D words, uint i) {
  countLookups(1);
  uint columns = uint(textureSize(words, 0).x);
  return wordOf(texelFetch(words, ivec2(i & (columns - 1u), i >> findMSB(columns)), 0));
}

ivec2 unpacked(uint code) { return ivec2(code & 0xFFFFu, code >> 16); }

// A texel's normal as its point of the square, 16 bits per axis.
const uint no_normal = 0xFFFFFFFFu;
const uint up_code = 0x80008000u;  // (0, 0, 1)

ivec2 cellOfPacked(uint code, float across) {
  uint m = uint(across);
  return ivec2((code & 0xFFFFu) * m >> 16, (code >> 16) * m >> 16);
}

uint binOfPacked(uint code) {
  ivec2 cell = cellOfPacked(code, bins_across);
  return uint(cell.y) * uint(bins_across) + uint(cell.x);
}

vec3 unpackedNormal(uint code) { return squareToHemisphere((vec2(unpacked(code)) + 0.5) / 65536.0); }

ivec2 cellOf(vec3 direction) {
  return clamp(ivec2(floor(hemisphereToSquare(direction) * bins_across)), ivec2(0), ivec2(int(bins_across) - 1));
}

uint binIn(ivec2 cell) { return uint(cell.y) * uint(bins_across) + uint(cell.x); }

// The value of normals, of a texel or of a bin: a density at h, or a reflectance.

struct Query {
  bool reflects;  // f * cos without the Fresnel term; otherwise the density
  vec3 h;
  vec3 wi;
  vec3 wo;
  uint bin;       // of h
};

Query queryFor(bool reflects, vec3 h, vec3 wi, vec3 wo) { return Query(reflects, h, wi, wo, binIn(cellOf(h))); }

float binSolidAngle() { return 2.0 * pi / (bins_across * bins_across); }

#if ROUGHNESS_FLAKES
// Beckmann's density about a flake's normal, over solid angle (Walter 2007, equation 25).
float flakeDensity(float alpha, vec3 n, vec3 h) {
  countLobes(1);
  float c = dot(n, h);
  if (c <= 1e-3) return 0.0;
  vec3 s = cross(n, h);
  float c2 = c * c;
  float a2 = alpha * alpha;
  return exp(-dot(s, s) / (c2 * a2)) / (pi * a2 * c2 * c2);
}

float baseVariance(Footprints f) { return 0.5 * option_alpha * option_alpha; }

// The value of normals with a slope variance of `spread` per axis about `normal`.
float valueAbout(float variance, vec3 normal, float spread, Query q) {
  float alpha = sqrt(2.0 * (variance + spread));
  float density = flakeDensity(alpha, normal, q.h);
#if SURFACE_FACETS
  if (q.reflects) density *= geometryFactor(lobeFromAlpha(alpha), normal, q.h, q.wi, q.wo);
#endif
  return density;
}
#elif ROUGHNESS_BIN && SURFACE_FACETS
float baseVariance(Footprints f) { return binSolidAngle() / 12.0; }  // variance of a square of area |H| along an axis
#elif ROUGHNESS_LOBE
float valueAbout(float variance, vec3 normal, float spread, Query q) {
  Facets facets = spreadFacets(normal, variance, spread);
#if SURFACE_FACETS
  if (q.reflects) return facetReflectance(facets, q.h, q.wi, q.wo);
#endif
  return facetDensity(facets, q.h);
}
#endif

// Applies the factors of all normals. `value` is their mean density or, for facets with lobes, their mean reflectance.
float finishedValue(float variance, float value, Query q) {
  if (!q.reflects || value == 0.0) return value;
#if SURFACE_MICROFACETS
  // Walter 2007: D cos integrates to one over a surface about its own normal; here D over solid angle does.
  vec3 up = vec3(0.0, 0.0, 1.0);
  return value / max(q.h.z, 1e-3) * geometryFactor(lobeFromVariance(variance), up, q.h, q.wi, q.wo);
#elif ROUGHNESS_BIN
  // Mirrors that face h, spread over their bin.
  return value * geometryFactor(lobeFromVariance(variance), q.h, q.h, q.wi, q.wo);
#else
  return value;
#endif
}

#if LOBES_LISTED || SAMPLING_FRAME && NORMAL_VARIATION && !ROUGHNESS_BIN
// Section 2.1: draws normals from D. A point of the footprint, the bin of its texel, and a normal anywhere in that bin.

// A drawn texel, and the share of the footprint that it represents: 0 without a texel or a normal.
struct DrawnTexel {
  uint code;
  float variance;  // of the lobe about it
  float share;
};

// Point i of a sequence that fills [0, 1)^4 evenly: multiples of powers of 1 / g with g^5 = g + 1 (Roberts 2018).
vec4 evenPoint(int i) { return fract(0.5 + float(i + 1) * vec4(0.85667488, 0.73389186, 0.62870672, 0.53859726)); }

// The normal that a texel reflects about: its own or, if only its bin is known, one at `place` in the bin.
vec3 normalOf(uint code, vec2 place) {
#if ROUGHNESS_BIN
  return squareToHemisphere((vec2(cellOfPacked(code, bins_across)) + place) / bins_across);
#else
  return unpackedNormal(code);
#endif
}
#endif
#if SAMPLING_FRAME && NORMAL_VARIATION
#include "atanasov_bins_footprint.glsl"
#else
// One normal per sample: a texel of the finest level, or a surface without a normal map.
struct Effective {
  vec3 normal;
  uint code;       // the packed normal
  float variance;  // of the base lobe
};

Effective effective(Footprints f) {
  Effective e;
  e.variance = baseVariance(f);
#if NORMAL_VARIATION
  uint code = wordOf(fetchFinest(bins_map, f.normal));
#if !SAMPLING_FRAME
  nothing_to_shade = code == no_normal;
#endif
  e.normal = unpackedNormal(code);
  e.code = code;
#else
  e.normal = vec3(0.0, 0.0, 1.0);
  e.code = up_code;
#endif
  return e;
}

float meanValue(Effective e, Query q) {
#if ROUGHNESS_BIN
  countLobes(1);
  float value = q.bin == binOfPacked(e.code) ? 1.0 / binSolidAngle() : 0.0;
#else
  float value = valueAbout(e.variance, e.normal, 0.0, q);
#endif
  return finishedValue(e.variance, value, q);
}

vec3 meanNormal(Effective e) { return e.normal; }

#if LOBES_LISTED
// A single texel: only the place in its bin is drawn.
int drawCount(Effective e) {
#if ROUGHNESS_BIN
  return int(option_draws);
#else
  return 1;
#endif
}

DrawnTexel drawnTexel(Effective e, int i) { return DrawnTexel(e.code, e.variance, 1.0 / float(drawCount(e))); }
#endif
#endif

float reflectedDensity(Effective e, vec3 h, vec3 wi, vec3 wo) { return meanValue(e, queryFor(true, h, wi, wo)); }

#include "density_module.glsl"

float ndf(Effective e, vec3 h) { return meanValue(e, queryFor(false, h, h, h)); }

#if LOBES_LISTED
// Environment light: the drawn normals, each with the reflection of its texel, are the lobes of the NDF.

#if ROUGHNESS_LOBE
int lobesOfTexel() { return facetLobeCount(); }

NormalLobe lobeOfTexel(float variance, vec3 normal, int k, float share) {
  return facetNormalLobe(spreadFacets(normal, variance, 0.0), k, share);
}
#else
int lobesOfTexel() { return 1; }

NormalLobe lobeOfTexel(float variance, vec3 normal, int k, float share) {
#if ROUGHNESS_BIN
  const float sharpness = 1e6;  // a mirror, sharper than any environment map
#else
  float sharpness = 1.0 / variance;
#endif
  return NormalLobe(normal, sharpness, share, lobeFromVariance(variance), false, normal);
}
#endif

int lobeCount(Effective e) { return lobesOfTexel() * drawCount(e); }

NormalLobe normalLobe(Effective e, int i) {
  int number = i / lobesOfTexel();
  DrawnTexel texel = drawnTexel(e, number);
  vec3 normal = normalOf(texel.code, evenPoint(number).zw);
  NormalLobe lobe = lobeOfTexel(texel.variance, normal, i - number * lobesOfTexel(), texel.share);
#if SURFACE_MICROFACETS
  // Walter 2007: D over the cosine, masked about the surface's own normal.
  lobe.weight /= max(lobe.axis.z, 1e-3);
  lobe.normal = vec3(0.0, 0.0, 1.0);
#endif
  return lobe;
}

float lobeGeometry(Effective e, NormalLobe lobe, vec3 h, vec3 wi, vec3 wo) {
  return geometryFactor(lobe.base, lobe.normal, h, wi, wo);
}
#endif
