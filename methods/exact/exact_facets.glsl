// The facet at a place of the finest level, and sums over facets. Places lie on a grid over one map, the normal map
// where there is one: its texels, or parts of them where another map has finer ones.
//? if normal_layers
//? include normal_layers.glsl
//? end

// Where another map is looked up, from the distance to the pixel's centre on the grid's map: all coordinates are linear
// over a pixel.
struct Mapped {
  vec2 centre;
  mat2 turn;
};

struct Effective {
  Footprint footprint;  // on the grid's map
  vec2 size;            // of the whole map, in places
//? if normal_variation and normal_layers
  Mapped layer;
//? end
//? if roughness_variation
  Mapped roughness;
//? end
};

// A position q of the pixel's centre and edges (dx, dy), q in [-1/2, 1/2]^2, is at uv + (dx dy) q on each map.
Mapped mappedFrom(Footprint grid, Footprint other) {
  mat2 edges = mat2(grid.dx, grid.dy);
  if (determinant(edges) == 0.0) return Mapped(other.uv, mat2(0.0));  // seen edge-on: a line, or nothing
  return Mapped(other.uv, mat2(other.dx, other.dy) * inverse(edges));
}

// Places a texel of the grid's map is cut into along each axis, so that one is no larger than another map's texel. Of
// one part in fifty more than a whole number nothing is made: footprints are differences in 32 bits.
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
//? if normal_variation
  e.footprint = f.normal;
  e.size = vec2(textureSize(base_normal, 0));
//? if normal_layers
  e.layer = mappedFrom(f.normal, f.layer);
  parts = max(parts, partsOf(e.size, e.layer, vec2(textureSize(base_layer, 0))));
//? end
//? elif normal_layers
  e.footprint = f.layer;
  e.size = vec2(textureSize(base_layer, 0));
//? else
  e.footprint = f.roughness;
  e.size = vec2(textureSize(base_roughness, 0));
//? end
//? if roughness_variation
//? if shared_coordinates and normal_variation
  e.roughness = Mapped(f.roughness.uv, mat2(1.0));
//? else
  e.roughness = mappedFrom(e.footprint, f.roughness);
//? end
  parts = max(parts, partsOf(e.size, e.roughness, vec2(textureSize(base_roughness, 0))));
//? end
  e.size *= parts;
  return e;
}

// What is asked of each facet: its reflectance but for the Fresnel term, or its density of normals at h.
struct Query {
  bool reflects;
  bool has_half_vector;
  vec3 h;
  vec3 wi;
  vec3 wo;
};

struct Sum {
  float specular;  // densities, times geometry factors where it reflects
  float facing;    // cosines to wi of facets that face it
  float weight;
};

// Facets are added up in groups: of many thousand terms added to one sum in 32 bits each would be off by a part in a
// hundred.
Sum zeroSum() { return Sum(0.0, 0.0, 0.0); }

void addSum(inout Sum sum, Sum part, float weight) {
  sum.specular += weight * part.specular;
  sum.facing += weight * part.facing;
  sum.weight += weight * part.weight;
}

vec4 normalAt(Effective e, vec2 uv) {
//? if normal_variation
  countLookups(1);
  vec4 normal = textureLod(base_normal, uv, 0.0);
//? if normal_layers
  vec4 layer = textureLod(base_layer, e.layer.centre + e.layer.turn * (uv - e.footprint.uv), 0.0);
  return vec4(withSlopesAdded(normal.xyz, layer.xyz), min(normal.w, layer.w));
//? else
  return normal;
//? end
//? elif normal_layers
  vec4 layer = textureLod(base_layer, uv, 0.0);
  return vec4(withSlopesAdded(vec3(0.0, 0.0, 1.0), layer.xyz), layer.w);
//? else
  return vec4(0.0, 0.0, 1.0, 1.0);
//? end
}

Facets facetsAbout(Effective e, vec3 normal, vec2 uv) {
//? if roughness_variation
  vec2 at = e.roughness.centre + e.roughness.turn * (uv - e.footprint.uv);
  return evenFacets(normal, lobeFromRoughness(textureLod(base_roughness, at, 0.0).r));
//? else
  return evenFacets(normal, lobe_cutoff.x);
//? end
}

void addFacets(inout Sum sum, Facets facets, float weight, Query q) {
  sum.weight += weight;
//? if diffuse
  sum.facing += weight * max(dot(facets.normal, q.wi), 0.0);
//? end
  if (!q.has_half_vector) return;
  sum.specular += weight * (q.reflects ? facetReflectance(facets, q.h, q.wi, q.wo) : facetDensity(facets, q.h));
}

// Adds the facet at a place; none is there where the map has no normal.
void addPlace(inout Sum sum, Effective e, vec2 place, float weight, Query q) {
  vec2 uv = place / e.size;
  vec4 normal = normalAt(e, uv);
  if (normal.w < 0.5 || weight <= 0.0) return;
  addFacets(sum, facetsAbout(e, normal.xyz, uv), weight, q);
}

// Of loops that the driver has ended early. llvmpipe does after 65535 rounds of all loops of a pixel together, over all
// lights: no picture may pass for whole then. (Four places a round make that enough for seven lights and more.)
Sum notWhole() {
  float no_number = uintBitsToFloat(0x7fc00000u);
  return Sum(no_number, no_number, no_number);
}

// A mean; over nothing but texels without a normal that of an even facet, as methods have it that blend normals.
Sum meanOf(Sum sum, Effective e, Query q) {
  if (sum.weight <= 0.0) {
    sum = zeroSum();
    addFacets(sum, facetsAbout(e, vec3(0.0, 0.0, 1.0), e.footprint.uv), 1.0, q);
  }
  return Sum(sum.specular / sum.weight, sum.facing / sum.weight, 1.0);
}

//? include random_numbers.glsl

// Where in a cell of places, `edge` on each side, its one place lies: anywhere in a cell of several, by numbers of the
// cell's own, so that tiles and neighbouring pixels agree.
vec2 placeIn(ivec2 cell, float edge) {
  if (edge <= 1.0) return vec2(cell) + 0.5;
  uvec3 bits = hashed(uvec3(cell, int(edge)));
  return (vec2(cell) + (vec2(bits.xy >> 8u) + 0.5) * (1.0 / 16777216.0)) * edge;
}

// How many texels may be looked at one by one: all parts of a pixel share them.
float mostTexels() {
//? if filter_shaded
  return option_texels * option_texels / float(footprint_parts * footprint_parts);
//? else
  return option_texels * option_texels;
//? end
}
