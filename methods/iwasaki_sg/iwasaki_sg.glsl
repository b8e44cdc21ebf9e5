// Iwasaki, Dobashi, Nishita 2012: the visible normals of a pair of directions are a sum of spherical Gaussians. Their
// axes and sharpnesses are the material's, and their amplitudes depend on the pair. Convolved with the base BRDF they
// give the effective BRDF.

#include "iwasaki_sg_lobes.glsl"

// Constant over pixels, because the tables serve the whole material.
struct Effective {
  int count;  // of lobes
};

#if MICROGEOMETRY_VISIBILITY || NORMAL_VARIATION
int tableLobes() { return textureSize(iwasaki_lobes, 0).x; }
// Axis and sharpness of a lobe of the facets' normals.
vec4 lobeOf(int j) {
  countLookups(1);
  vec4 lobe = texelFetch(iwasaki_lobes, ivec2(j, 0), 0);
  return vec4(lobe.xyz, ownSharpness(lobe.w));
}

float shareOf(int j) {
  countLookups(1);
  return texelFetch(iwasaki_lobes, ivec2(j, 1), 0).x;
}
#else
int tableLobes() { return 1; }
vec4 lobeOf(int j) { return vec4(0.0, 0.0, 1.0, ownSharpness(sharpest)); }
float shareOf(int j) { return 1.0; }
#endif

Effective effective(Footprints f) { return Effective(tableLobes()); }

#if MICROGEOMETRY_VISIBILITY
#include "direction_grid.glsl"

// The position of a pair of directions in the table: one tile for each cell of wo, with one texel for each cell of wi.
// The sampler interpolates between cells of wi, and four tiles are interpolated between cells of wo.
struct TableTexels {
  vec2 uv[4];
  vec4 weights;
};

TableTexels tableTexels(vec3 wi, vec3 wo) {
  float side = option_directions;
  vec2 i = clamp(hemisphereToSquare(wi) * side, 0.5, side - 0.5);
  vec2 o = clamp(hemisphereToSquare(wo) * side, 0.5, side - 0.5) - 0.5;
  vec2 low = min(floor(o), side - 2.0);
  vec2 part = o - low;
  TableTexels texels;
  for (int k = 0; k < 4; ++k) texels.uv[k] = ((low + vec2(k & 1, k >> 1)) * side + i) / (side * side);
  texels.weights =
      vec4((1.0 - part.x) * (1.0 - part.y), part.x * (1.0 - part.y), (1.0 - part.x) * part.y, part.x * part.y);
  return texels;
}

vec4 tableLayer(int layer, TableTexels texels) {
  countLookups(4);
  vec4 sum = vec4(0.0);
  for (int k = 0; k < 4; ++k) sum += texels.weights[k] * textureLod(iwasaki_amplitudes, vec3(texels.uv[k], layer), 0.0);
  return sum;
}

// The values of the table: the lobes, followed by the diffuse term. In colour each has a layer, otherwise four share a
// layer.
#if MICROGEOMETRY_COLOUR
const int values_per_layer = 1;
vec3 valueIn(vec4 layer, int value) { return layer.rgb; }
#else
const int values_per_layer = 4;
vec3 valueIn(vec4 layer, int value) { return vec3(layer[value & 3]); }
#endif

vec3 tableAt(int value, TableTexels texels) { return valueIn(tableLayer(value / values_per_layer, texels), value); }
#endif

// The base BRDF's density of half vectors, averaged over the normals of a lobe.
float convolved(vec4 lobe, vec3 h) {
#if LOBE_BASE
  return lobeDensity(lobeFromVariance(lobeVariance(lobe_cutoff.x) + 1.0 / lobe.w), lobe.xyz, h);
#else
  float sum = 0.0;
  int count = textureSize(iwasaki_brdf, 0).x;
  countLookups(count);
  countLobes(count);
  int s = 0;
  do {
    vec2 brdf = texelFetch(iwasaki_brdf, ivec2(s, 0), 0).xy;  // sharpness, amplitude
#if CONVOLUTION_EXACT
    sum += brdf.y * sgConvolution(lobe.xyz, lobe.w, h, brdf.x);
#else
    sum += brdf.y * sgApproximateConvolution(lobe.xyz, lobe.w, h, brdf.x);
#endif
  } while (++s < count);
  return sum / sgIntegral(lobe.w);
#endif
}

// The geometry term of the facets of a lobe, at the normal that maximises the product of lobe and base BRDF, because it
// varies slowly (Wang et al. 2009 treat smooth factors of a BRDF in this way).
float smoothFactor(vec4 lobe, vec3 h, vec3 wi, vec3 wo) {
#if COSINES_PUBLISHED && MICROGEOMETRY_VISIBILITY
  return max(wi.z, 0.0);  // the table stores the facets' cosine divided by this one
#elif COSINES_PUBLISHED
  return max(dot(lobe.xyz, wi), 0.0);
#elif MASKING_SHADOWING || HORIZON_OPEN
  vec3 sum = lobe.w * lobe.xyz + h / lobeVariance(lobe_cutoff.x);
  vec3 n = sum / max(length(sum), 1e-6);
  return geometryFactor(lobe_cutoff.x, n, h, wi, wo);
#else
  return 1.0;
#endif
}

#if MICROGEOMETRY_VISIBILITY && TABULATED_BRDF
// The factor on the lobes of a tabulated BRDF by the difference angle.
vec3 riseOf(vec3 h, vec3 wi) {
  int last = textureSize(iwasaki_rise, 0).x - 1;
  float angle = atan(length(cross(wi, h)), max(dot(wi, h), 0.0));  // acos is coarse on some machines
  float position = clamp(angle / (0.5 * pi) * float(last + 1) - 0.5, 0.0, float(last));
  int low = min(int(position), max(last - 1, 0));
  vec3 below = texelFetch(iwasaki_rise, ivec2(low, 0), 0).rgb;
  return mix(below, texelFetch(iwasaki_rise, ivec2(min(low + 1, last), 0), 0).rgb, position - float(low));
}

// Facets with coloured lobes of their own, the first of which is diffuse (equations 9 and 15 in one). The table stores
// the facets' cosine to the light divided by that of the surface.
vec3 tabulatedReflection(Effective e, vec3 wi, vec3 wo) {
  if (!halfVectorIsDefined(wi, wo)) return vec3(0.0);
  vec3 h = halfVector(wi, wo);
  TableTexels texels = tableTexels(wi, wo);
  int count = textureSize(iwasaki_table, 0).x;
  vec3 shine = vec3(0.0), matte = vec3(0.0);
  vec4 layer = vec4(0.0);
  int lobes = lobesHere(e.count);
  int j = 0;
  do {
    if (j % values_per_layer == 0) layer = tableLayer(j / values_per_layer, texels);
    vec4 lobe = lobeOf(j);
    vec3 reflected = vec3(0.0);
    for (int s = 1; s < count; ++s) {
      vec4 brdf = texelFetch(iwasaki_table, ivec2(s, 0), 0);
      reflected += brdf.yzw * sgConvolution(lobe.xyz, lobe.w, h, brdf.x);
    }
    shine += valueIn(layer, j) * reflected / sgIntegral(lobe.w);
    matte += valueIn(layer, j);
  } while (++j < lobes);
  return (shine * riseOf(h, wi) + matte * texelFetch(iwasaki_table, ivec2(0), 0).yzw) * max(wi.z, 0.0);
}
#endif

// f * cos of the facets with their own lobes.
vec3 lobesReflect(Effective e, vec3 f0, vec3 wi, vec3 wo) {
  if (!halfVectorIsDefined(wi, wo)) return vec3(0.0);
  vec3 h = halfVector(wi, wo);
#if MICROGEOMETRY_VISIBILITY
  TableTexels texels = tableTexels(wi, wo);
  vec4 layer = vec4(0.0);
#endif
  vec3 sum = vec3(0.0);
  int count = lobesHere(e.count);
  int j = 0;
  do {
    vec4 lobe = lobeOf(j);
    float reflected = convolved(lobe, h) * smoothFactor(lobe, h, wi, wo);
#if MICROGEOMETRY_VISIBILITY
    if (j % values_per_layer == 0) layer = tableLayer(j / values_per_layer, texels);
    sum += valueIn(layer, j) * reflected;
#else
    sum += shareOf(j) * reflected;
#endif
  } while (++j < count);
  return fresnelTerm(f0, wi, wo) * sum;
}

#if DIFFUSE
vec3 meanDiffuse(Effective e, Surface s, vec3 wi, vec3 wo) {
#if MICROGEOMETRY_VISIBILITY
  // The table stores the facets' cosines divided by that of the whole surface.
  return diffuse(vec3(0.0, 0.0, 1.0), s, wi, wo) * tableAt(e.count, tableTexels(wi, wo));
#else
  vec3 sum = vec3(0.0);
  int count = lobesHere(e.count);
  int j = 0;
  do {
    vec4 lobe = lobeOf(j);
    sum += shareOf(j) * meanCosine(lobe.w) * diffuse(lobe.xyz, s, wi, wo);
  } while (++j < count);
  return sum;
#endif
}
#endif

Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo) {
  Reflected r;
#if MICROGEOMETRY_VISIBILITY && TABULATED_BRDF
  if (iwasaki_tabulated > 0.5) {
    r.specular = tabulatedReflection(e, wi, wo);
#if DIFFUSE
    r.diffuse = vec3(0.0);  // included in tabulatedReflection
#endif
    return r;
  }
#endif
  r.specular = lobesReflect(e, s.f0, wi, wo);
#if DIFFUSE
  r.diffuse = meanDiffuse(e, s, wi, wo);
#endif
  return r;
}

float ndf(Effective e, vec3 h) {
  float sum = 0.0;
  for (int j = 0; j < e.count; ++j) sum += shareOf(j) * convolved(lobeOf(j), h);
  return sum;
}

#if LOBES_LISTED
#include "iwasaki_sg_environment.glsl"
#endif
