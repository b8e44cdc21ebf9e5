// The footprint of a pixel on a map, and the functions that read a texture over it.

// Centre and edges of the pixel's parallelogram, in texture coordinates.
struct Footprint {
  vec2 uv;
  vec2 dx;
  vec2 dy;
};

// One footprint per map of the material, because maps may have different coordinates.
struct Footprints {
  Footprint normal;
  Footprint roughness;
  Footprint base_color;
#if SPECULAR_VARIATION
  Footprint specular;
#endif
#if SURFACE_COORDINATES
  Footprint surface;  // on textures that show each point of the surface once
#endif
#if NORMAL_LAYERS
  Footprint layer;
#endif
#if CLEAR_COAT && COAT_WEIGHT_VARIATION
  Footprint coat_weight;
#endif
#if CLEAR_COAT && COAT_WIDTH_VARIATION
  Footprint coat_width;
#endif
#if CLEAR_COAT && COAT_NORMAL_VARIATION
  Footprint coat_normal;
#endif
#if MATERIAL_INDEX
  Footprint share;
#endif
#if EMISSION_VARIATION
  Footprint emission;
#endif
#if OCCLUSION
  Footprint occlusion;
#endif
#if SCREEN_DERIVATIVES
  mat3 frame_dx;  // what the tangent frame's axes change by to the pixel on the right, in those axes
  mat3 frame_dy;  // and to the one above
#endif
};

#if SCREEN_DERIVATIVES
// The change of the unit half vector of one light to the pixels on the right and above, each in its own tangent frame.
struct HalfSteps {
  vec3 dx;
  vec3 dy;
};
#endif

#if SCREEN_DERIVATIVES && FILTER_PARTS
mat2 part_edges;  // of the part of the footprint that is shaded, in pixels
#endif
#if SURFACE_COORDINATES || SCREEN_DERIVATIVES
// Rotates from the tangent frame of the shaded point to the axes of the camera: x right, y up, z towards the viewer.
mat3 tangent_to_camera;
#endif

// The size of a mip level. llvmpipe evaluates `textureSize` with one level for eight pixels, even if neighbours differ.
vec2 levelSize(ivec2 finest, int level) { return vec2(max(finest >> level, ivec2(1))); }

// Count texture lookups and lobe evaluations per pixel, on request. Modules with lookups or lobes of their own call
// them too.
#if COUNTING
int lookups = 0;
int lobe_evaluations = 0;
float finest_area = 0.0;  // of the pixel on a map whose finest level is read whatever the footprint; the whole map has 1
void countLookups(int count) { lookups += count; }
void countLobes(int count) { lobe_evaluations += count; }
void countFinest(Footprint f) { finest_area = max(finest_area, abs(determinant(mat2(f.dx, f.dy)))); }
#else
void countLookups(int count) {}
void countLobes(int count) {}
void countFinest(Footprint f) {}
#endif

// The rounds of loops that depend on the pixel: constants in programs whose cost is estimated, because compilers must
// unroll them (docs/explanation/gpu-cost.md). A counting program writes their means.
#if FIXED_TRIPS
int probesHere(int count) { return fixed_probes; }
int lobesHere(int count) { return fixed_lobes; }
bool anotherRound(int done, bool more) { return done < fixed_rounds; }
#elif COUNTING_TRIPS
ivec2 probe_trips = ivec2(0);  // rounds and loops
ivec2 lobe_trips = ivec2(0);
ivec2 walk_trips = ivec2(0);
int probesHere(int count) {
  probe_trips += ivec2(count, 1);
  return count;
}
int lobesHere(int count) {
  lobe_trips += ivec2(count, 1);
  return count;
}
bool anotherRound(int done, bool more) {
  if (!more) walk_trips += ivec2(done, 1);
  return more;
}
float meanTrips(ivec2 trips) { return float(trips.x) / float(max(trips.y, 1)); }
#else
int probesHere(int count) { return count; }
int lobesHere(int count) { return count; }
bool anotherRound(int done, bool more) { return more; }
#endif

const float any_level = 1e3;  // no level is as coarse

#if SAMPLING_FRAME
#include "footprint_probes.glsl"
#if TEXTURE_ARRAYS
vec4 fetchProbes(sampler2DArray map, int layer, Footprint f, Probes p, float level) {
  countLookups(p.count);
  vec4 sum = vec4(0.0);
  int i = 0;
  do {
    sum += probeWeight(p, i) * textureLod(map, vec3(probeUv(f, p, i), layer), level);
  } while (++i < p.count);
  return sum;
}

#endif
#if FILTER_HARDWARE
vec4 fetch(sampler2D map, Footprint f) {
  countLookups(1);
  return textureGrad(map, f.uv, f.dx, f.dy);
}

#if TEXTURE_ARRAYS
vec4 fetch(sampler2DArray map, int layer, Footprint f) {
  countLookups(1);
  return textureGrad(map, vec3(f.uv, layer), f.dx, f.dy);
}
#endif
#else
vec4 fetch(sampler2D map, Footprint f) {
  Probes p = probesOf(vec2(textureSize(map, 0)), f);
  countLookups(p.count);
  vec4 sum = vec4(0.0);
  int i = 0;
  do {
    sum += probeWeight(p, i) * textureLod(map, probeUv(f, p, i), p.level);
  } while (++i < p.count);
  return sum;
}

#if TEXTURE_ARRAYS
vec4 fetch(sampler2DArray map, int layer, Footprint f) {
  Probes p = probesOf(vec2(textureSize(map, 0).xy), f);
  return fetchProbes(map, layer, f, p, p.level);
}
#endif
#endif

#if TEXTURE_ARRAYS
// Reads a layer like `fetch`, limited to levels up to `coarsest`, which hardware filters cannot be.
vec4 fetchUpTo(sampler2DArray map, int layer, Footprint f, float coarsest) {
#if FILTER_HARDWARE
  if (coarsest >= any_level) return fetch(map, layer, f);
#endif
  Probes p = probesOf(vec2(textureSize(map, 0).xy), f);
  return fetchProbes(map, layer, f, p, min(p.level, coarsest));
}
#endif
#endif

#if RANDOM_DRAWS
vec2 texel_draw;  // of this sample, uniform in [0, 1)
#endif

// The place at which the finest level of a map is read. A sample of the reference draws one texel with bilinear weights
// by a sampler that must be `nearest`: the expectation of the shaded value is then the bilinear filter of radiance.
// Maps with the same size and coordinates draw the same texel. At a point, the sampler selects nearest or bilinear
// filtering.
vec2 finestUv(vec2 size, Footprint f) {
#if SAMPLING_TEXEL
  return (floor(f.uv * size - 0.5 + texel_draw) + 0.5) / size;
#else
  return f.uv;
#endif
}

// The finest level without filtering.
vec4 fetchFinest(sampler2D map, Footprint f) {
  countLookups(1);
  countFinest(f);
  return textureLod(map, finestUv(vec2(textureSize(map, 0)), f), 0.0);
}
#if TEXTURE_ARRAYS
vec4 fetchFinest(sampler2DArray map, int layer, Footprint f) {
  countLookups(1);
  countFinest(f);
  return textureLod(map, vec3(finestUv(vec2(textureSize(map, 0).xy), f), layer), 0.0);
}
#endif

#if !SAMPLING_FRAME
vec4 fetch(sampler2D map, Footprint f) { return fetchFinest(map, f); }
#if TEXTURE_ARRAYS
vec4 fetch(sampler2DArray map, int layer, Footprint f) { return fetchFinest(map, layer, f); }
vec4 fetchUpTo(sampler2DArray map, int layer, Footprint f, float coarsest) { return fetchFinest(map, layer, f); }
#endif
#endif

#if TEXEL_LOOKUPS
// Iterates over the texels that `fetch` would blend: eight of two levels per probe. For maps whose texels must not be
// blended. Only the size of the map is given; its chain ends at one texel.
struct FootprintTexel {
  vec2 uv;       // the texel's centre, at its level
  float level;
  float weight;  // of this texel; all weights of a footprint sum to one
};

#if SAMPLING_FRAME
int footprintTexelCount(ivec2 finest, Footprint f) { return 8 * probesOf(vec2(finest), f).count; }

FootprintTexel footprintTexel(ivec2 finest, Footprint f, int i) {
  Probes p = probesOf(vec2(finest), f);
  vec2 uv = probeUv(f, p, i >> 3);
  float level = p.level;
  float share = probeWeight(p, i >> 3);
  float coarsest = float(findMSB(max(finest.x, finest.y)));
  level = clamp(level, 0.0, coarsest);
  float lower = floor(level);
  bool coarser = (i & 4) != 0;
  float own = min(coarser ? lower + 1.0 : lower, coarsest);
  vec2 size = levelSize(finest, int(own));
  vec2 in_texels = uv * size - 0.5;
  vec2 corner = floor(in_texels);
  vec2 part = in_texels - corner;
  vec2 side = vec2(i & 1, (i >> 1) & 1);
  vec2 bilinear = mix(1.0 - part, part, side);
  float between = coarser ? level - lower : 1.0 - (level - lower);
  return FootprintTexel((corner + side + 0.5) / size, own, share * between * bilinear.x * bilinear.y);
}
#else
int footprintTexelCount(ivec2 finest, Footprint f) { return 1; }
FootprintTexel footprintTexel(ivec2 finest, Footprint f, int i) {
  return FootprintTexel(finestUv(vec2(finest), f), 0.0, 1.0);
}
#endif

int footprintTexelCount(sampler2DArray map, Footprint f) { return footprintTexelCount(textureSize(map, 0).xy, f); }
FootprintTexel footprintTexel(sampler2DArray map, Footprint f, int i) {
  return footprintTexel(textureSize(map, 0).xy, f, i);
}

vec4 fetchTexel(sampler2DArray map, int layer, FootprintTexel t) {
  countLookups(1);
  return textureLod(map, vec3(t.uv, layer), t.level);
}
#endif
