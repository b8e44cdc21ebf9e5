// Sums the base BRDF over the texels of the finest level under a kernel. Samples of a supersampled image draw one texel
// each, as the reference does. A material without varying maps is a single facet everywhere.
#if !SAMPLING_FRAME || !NORMAL_VARIATION && !NORMAL_LAYERS && !ROUGHNESS_VARIATION
#include "base_surface.glsl"
#if ENVIRONMENT_SUMMED

vec3 environmentLit(Effective e, Surface s, vec3 wo, mat3 frame);  // environment_stack.glsl

vec3 environmentSum(Effective e, Surface s, vec3 wo, mat3 frame) { return environmentLit(e, s, wo, frame); }
#endif
#else
// Facets at places of the finest level, and sums over facets. Places form a grid over one map, the normal map if there is
// one. A place is a texel of it, or a part of a texel if another map is finer.
#if NORMAL_LAYERS
#include "normal_layers.glsl"
#endif

// Maps a distance from the pixel's centre on the grid's map to coordinates on another map. All coordinates are linear over
// a pixel.
struct Mapped {
  vec2 centre;
  mat2 turn;
};

struct Effective {
  Footprint footprint;  // on the grid's map
  vec2 size;            // of the whole map, in places
#if ENVIRONMENT_SUMMED
  Facets facets;  // which the environment lights in the current call
#endif
#if NORMAL_VARIATION && NORMAL_LAYERS
  Mapped layer;
#endif
#if ROUGHNESS_VARIATION
  Mapped roughness;
#endif
};

// A position q of the pixel's centre and edges (dx, dy), q in [-1/2, 1/2]^2, is at uv + (dx dy) q on each map.
Mapped mappedFrom(Footprint grid, Footprint other) {
  mat2 edges = mat2(grid.dx, grid.dy);
  if (determinant(edges) == 0.0) return Mapped(other.uv, mat2(0.0));  // seen edge-on
  return Mapped(other.uv, mat2(other.dx, other.dy) * inverse(edges));
}

// Places per texel of the grid's map along each axis, so that no place is larger than a texel of the other map. An excess
// of less than 1/50 over a whole number is ignored, because footprints are 32-bit differences.
vec2 partsOf(vec2 grid_size, Mapped other, vec2 other_size) {
  vec2 along_u = other.turn[0] * other_size / grid_size.x;
  vec2 along_v = other.turn[1] * other_size / grid_size.y;
  vec2 texels = vec2(max(abs(along_u.x), abs(along_u.y)), max(abs(along_v.x), abs(along_v.y)));
  const float finest = 16384.0;  // places along an axis
  return clamp(ceil(texels - 0.02), vec2(1.0), max(floor(finest / grid_size), 1.0));
}

Effective effective(Footprints f) {
  Effective e;
  vec2 parts = vec2(1.0);
#if NORMAL_VARIATION
  e.footprint = f.normal;
  e.size = vec2(textureSize(base_normal, 0));
#if NORMAL_LAYERS
  e.layer = mappedFrom(f.normal, f.layer);
  parts = max(parts, partsOf(e.size, e.layer, vec2(textureSize(base_layer, 0))));
#endif
#elif NORMAL_LAYERS
  e.footprint = f.layer;
  e.size = vec2(textureSize(base_layer, 0));
#else
  e.footprint = f.roughness;
  e.size = vec2(textureSize(base_roughness, 0));
#endif
#if ROUGHNESS_VARIATION
#if SHARED_COORDINATES && NORMAL_VARIATION
  e.roughness = Mapped(f.roughness.uv, mat2(1.0));
#else
  e.roughness = mappedFrom(e.footprint, f.roughness);
#endif
  parts = max(parts, partsOf(e.size, e.roughness, vec2(textureSize(base_roughness, 0))));
#endif
  e.size *= parts;
  return e;
}

// The value of each facet: its reflectance without the Fresnel term, its density of normals at h, or the environment light
// that it reflects.
struct Query {
  bool reflects;
  bool has_half_vector;
  vec3 h;
  vec3 wi;
  vec3 wo;
#if ENVIRONMENT_SUMMED
  bool surrounded;  // only the environment light
  Surface surface;
  mat3 frame;
#endif
};

Query reflectanceQuery(vec3 wi, vec3 wo) {
  Query q;
  q.reflects = true;
  q.has_half_vector = halfVectorIsDefined(wi, wo);
  q.h = halfVector(wi, wo);
  q.wi = wi;
  q.wo = wo;
#if ENVIRONMENT_SUMMED
  q.surrounded = false;
#endif
  return q;
}

Query densityQuery(vec3 h) {
  Query q = reflectanceQuery(h, h);
  q.reflects = false;
  q.has_half_vector = true;
  q.h = h;
  return q;
}

struct Sum {
  float specular;  // densities, times geometry factors if facets reflect
  float facing;    // cosines to wi, 0 for facets that face away
  float weight;
#if ENVIRONMENT_SUMMED
  vec3 radiance;
#endif
};

// Facets are summed in groups, because a single 32-bit sum of many thousand terms would lose about one percent.
Sum evenSum(float value) {
  Sum sum;
  sum.specular = value;
  sum.facing = value;
  sum.weight = value;
#if ENVIRONMENT_SUMMED
  sum.radiance = vec3(value);
#endif
  return sum;
}

Sum zeroSum() { return evenSum(0.0); }

void addSum(inout Sum sum, Sum part, float weight) {
  sum.specular += weight * part.specular;
  sum.facing += weight * part.facing;
  sum.weight += weight * part.weight;
#if ENVIRONMENT_SUMMED
  sum.radiance += weight * part.radiance;
#endif
}

vec4 normalAt(Effective e, vec2 uv) {
#if NORMAL_VARIATION
  countLookups(1);
  vec4 normal = textureLod(base_normal, uv, 0.0);
#if NORMAL_LAYERS
  vec4 layer = textureLod(base_layer, e.layer.centre + e.layer.turn * (uv - e.footprint.uv), 0.0);
  return vec4(withSlopesAdded(normal.xyz, layer.xyz), min(normal.w, layer.w));
#else
  return normal;
#endif
#elif NORMAL_LAYERS
  vec4 layer = textureLod(base_layer, uv, 0.0);
  return vec4(withSlopesAdded(vec3(0.0, 0.0, 1.0), layer.xyz), layer.w);
#else
  return vec4(0.0, 0.0, 1.0, 1.0);
#endif
}

Facets facetsAbout(Effective e, vec3 normal, vec2 uv) {
#if ROUGHNESS_VARIATION
  vec2 at = e.roughness.centre + e.roughness.turn * (uv - e.footprint.uv);
#if ANISOTROPY_VARIATION
  stretch = textureLod(stretch_map, at, 0.0).xy;
#endif
  return evenFacets(normal, lobeFromRoughness(textureLod(base_roughness, at, 0.0).r));
#else
  return evenFacets(normal, lobe_cutoff.x);
#endif
}

#if ENVIRONMENT_SUMMED
#include "facet_normal_lobes.glsl"

vec3 meanNormal(Effective e) { return e.facets.normal; }

vec3 environmentLit(Effective e, Surface s, vec3 wo, mat3 frame);  // of e's facets: environment_stack.glsl

#endif
void addFacets(inout Sum sum, Effective e, Facets facets, float weight, Query q) {
  sum.weight += weight;
#if ENVIRONMENT_SUMMED
  if (q.surrounded) {
    e.facets = facets;
    sum.radiance += weight * environmentLit(e, q.surface, q.wo, q.frame);
    return;
  }
#endif
#if DIFFUSE
  sum.facing += weight * max(dot(facets.normal, q.wi), 0.0);
#endif
  if (!q.has_half_vector) return;
  sum.specular += weight * (q.reflects ? facetReflectance(facets, q.h, q.wi, q.wo) : facetDensity(facets, q.h));
}

// Adds the facet at a place, if the map has a normal there.
void addPlace(inout Sum sum, Effective e, vec2 place, float weight, Query q) {
  vec2 uv = place / e.size;
  vec4 normal = normalAt(e, uv);
  if (normal.w < 0.5 || weight <= 0.0) return;
  addFacets(sum, e, facetsAbout(e, normal.xyz, uv), weight, q);
}

// The result of a loop that the driver ended early: not a number, so that no incomplete image passes unnoticed. Mesa
// 22.3's llvmpipe ends loops after 65535 rounds per pixel, over all loops and lights. Four places per round make that
// enough for seven lights and more.
Sum notWhole() { return evenSum(uintBitsToFloat(0x7fc00000u)); }

// The mean over a sum. If all texels lack a normal it is that of a flat facet, as with methods that blend normals.
Sum meanOf(Sum sum, Effective e, Query q) {
  if (sum.weight <= 0.0) {
    sum = zeroSum();
    addFacets(sum, e, facetsAbout(e, vec3(0.0, 0.0, 1.0), e.footprint.uv), 1.0, q);
  }
  Sum mean = zeroSum();
  addSum(mean, sum, 1.0 / sum.weight);
  return mean;
}

#include "random_numbers.glsl"

// The place that represents a cell of `edge` x `edge` places. It is drawn by a hash of the cell, so that tiles and
// neighbouring pixels agree.
vec2 placeIn(ivec2 cell, float edge) {
  if (edge <= 1.0) return vec2(cell) + 0.5;
  uvec3 bits = hashed(uvec3(cell, int(edge)));
  return (vec2(cell) + (vec2(bits.xy >> 8u) + 0.5) * (1.0 / 16777216.0)) * edge;
}

#if ENVIRONMENT_SUMMED
// The most texels for environment light, within the 65535 rounds of loops per pixel (notWhole). A texel takes 1 round, or
// 14 for a lobe with a tail. Fewer texels suffice than for lights, because environment light varies less between texels.
float mostSurroundedTexels() {
#if DISTRIBUTION_GGX
  const float rounds = 14.0;
#else
  const float rounds = 1.0;
#endif
  return 20000.0 / (rounds * float(facetLobeCount()));
}

#endif
// The most texels that are looked up one by one, which all parts of a pixel share.
float mostTexels(Query q) {
  float most = option_texels * option_texels;
#if ENVIRONMENT_SUMMED
  if (q.surrounded) most = min(most, mostSurroundedTexels());
#endif
#if FILTER_SHADED
  return most / float(footprint_parts * footprint_parts);
#else
  return most;
#endif
}
#if KERNEL_FILTER
#include "exact_filter.glsl"
#else
#include "exact_pixel.glsl"
#endif

Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo) {
  Sum sum = sumOver(e, reflectanceQuery(wi, wo));
  Reflected r;
  r.specular = fresnelTerm(s.f0, wi, wo) * sum.specular;
#if DIFFUSE
  r.diffuse = diffuse(wi * sum.facing, s, wi, wo);  // its dot product with wi is the mean of the facets'
#endif
  return r;
}

float ndf(Effective e, vec3 h) { return sumOver(e, densityQuery(h)).specular; }
#if ENVIRONMENT_SUMMED

vec3 environmentSum(Effective e, Surface s, vec3 wo, mat3 frame) {
  Query q = reflectanceQuery(wo, wo);
  q.surrounded = true;
  q.surface = s;
  q.frame = frame;
  return sumOver(e, q).radiance;
}
#endif
#endif
