// A footprint on the map as a parallelogram in texels, and the areas of boxes that it covers.
//
// Mesa 22.3's llvmpipe ends all loops of a pixel after 65535 rounds, over all lights, and truncates the sum. Therefore a
// call of the module has a budget of rounds, which its parts share; newer drivers have the same, for the same picture.
// Eight pixels are drawn together and wait for each other at the end of every loop, so the largest part of the eight
// counts.

#if LOBES_LISTED
const float other_rounds = 25000.0;  // drawn normals and their reflection
#else
const float other_rounds = 5000.0;   // lookups under the footprint
#endif

// The rounds of one region in one call. The mean of normals takes up to 256 per region, once per pixel.
float regionRounds(int regions) {
  float count = float(max(regions, 1));
  return (65535.0 - other_rounds - 256.0 * count) / (float(shade_calls) * count);
}

// The largest shares of its parts, measured with eight pixels whose lights, footprints and bins have little in common.
// Finding a list takes about 45 rounds, a drawn texel one, and the eight take 2.2 times the rounds of a walk. That is
// 0.2 for the texels of small footprints, which some of the eight may have, and 0.86 for lists (bins: 0.88). With
// hundreds of lights rounds do not suffice for any walk, and all texels are drawn.
float texelRounds(float rounds) { return min(0.2 * rounds, 4096.0); }
#if ROUGHNESS_BIN
const float walk_share = 0.4;
float mostLists(float rounds) { return 1.0; }
#else
const float walk_share = 0.28;
float mostLists(float rounds) { return rounds < 600.0 ? 0.0 : min(0.004 * rounds, 128.0); }
float drawnRounds(float rounds) { return rounds < 600.0 ? 0.6 * rounds : min(0.0625 * rounds, 1024.0); }
#endif

// The rounds of the walk of one of `lists`.
float walkRounds(float rounds, float lists) { return walk_share * rounds / max(lists, 1.0); }

// The most copies of a map along an axis; larger footprints count as the whole map. A walk takes about four rounds per
// copy that the footprint touches, and at most two fifths of its rounds are for these.
float mostPeriods(float rounds) {
#if ROUGHNESS_BIN
  const float most = 16.0;
#else
  const float most = 4.0;
#endif
  return clamp(sqrt(0.1 * walkRounds(rounds, mostLists(rounds))) - 1.0, 1.0, most);
}
#include "parallelogram.glsl"

struct Region {
  vec2 centre;   // in texels; (0, 0) is the first texel's corner
  mat2 edges;    // columns
  mat2 to_unit;  // to the square [-1/2, 1/2]^2
  vec2 reach;    // half of the sides of its bounding box
  float weight;  // the weights of a pixel's regions sum to 1
};

Region regionAbout(vec2 centre, mat2 edges, float weight) {
  return Region(centre, edges, inverse(edges), 0.5 * (abs(edges[0]) + abs(edges[1])), weight);
}

float areaOf(Region r) { return abs(determinant(r.edges)); }

vec2 mapSize() { return vec2(textureSize(bins_map, 0)); }

Region wholeMap(float weight) {
  vec2 size = mapSize();
  return regionAbout(0.5 * size, mat2(size.x, 0.0, 0.0, size.y), weight);
}

// A region of at least one texel, as with the bilinear filter where texels are large on screen.
Region regionOf(vec2 centre, mat2 edges, float weight, int regions) {
  Region r = regionAbout(centre, widened(edges, 1.0), weight);
  float periods = mostPeriods(regionRounds(regions));
  vec2 most = mix(vec2(0.5 * periods) * mapSize(), vec2(1e6), equal(vec2(bins_wrap_u, bins_wrap_v), vec2(2.0)));
  return all(lessThan(r.reach, most)) ? r : wholeMap(weight);  // also for NaN
}

#if FOOTPRINT_FILTER
// The texels that the footprint filter would blend, each as the finest-level texels that it covers.
int regionCount(Footprint f) { return footprintTexelCount(textureSize(bins_map, 0), f); }

Region regionAt(Footprint f, int i) {
  ivec2 finest = textureSize(bins_map, 0);
  FootprintTexel texel = footprintTexel(finest, f, i);
  vec2 texels = levelSize(finest, int(texel.level));
  // A map that does not repeat is continued by the outermost texel of the level.
  vec2 within = clamp(texel.uv, 0.5 / texels, 1.0 - 0.5 / texels);
  vec2 uv = mix(texel.uv, within, equal(vec2(bins_wrap_u, bins_wrap_v), vec2(2.0)));
  vec2 sides = vec2(finest) / texels;
  return regionOf(uv * vec2(finest), mat2(sides.x, 0.0, 0.0, sides.y), texel.weight, regionCount(f));
}
#else
int regionCount(Footprint f) { return 1; }

Region regionAt(Footprint f, int i) {
  mat2 edges = mat2(f.dx * mapSize(), f.dy * mapSize());
#if FOOTPRINT_BOX
  vec2 sides = abs(edges[0]) + abs(edges[1]);
  edges = mat2(sides.x, 0.0, 0.0, sides.y);
#endif
  return regionOf(f.uv * mapSize(), edges, 1.0, 1);
}
#endif

// The position of a box relative to a region.
const int outside = 0;
const int cut = 1;
const int inside = 2;

int sideOf(Region r, vec2 lower, vec2 upper) {
  vec2 half_sides = 0.5 * (upper - lower);
  vec2 middle = 0.5 * (upper + lower) - r.centre;
  vec2 at = abs(r.to_unit * middle);
  vec2 extent = mat2(abs(r.to_unit[0]), abs(r.to_unit[1])) * half_sides;
  if (any(greaterThanEqual(at - extent, vec2(0.5))) || any(greaterThanEqual(abs(middle) - half_sides, r.reach)))
    return outside;
  return all(lessThanEqual(at + extent, vec2(0.5 + 1e-6))) ? inside : cut;
}

// The area of a box that a region covers.
float areaWithin(Region r, vec2 lower, vec2 upper) {
  vec2 sides = upper - lower;
  mat2 to_box = mat2(1.0 / sides.x, 0.0, 0.0, 1.0 / sides.y);
  return coveredArea(to_box * (r.centre - 0.5 * (upper + lower)), to_box * r.edges) * sides.x * sides.y;
}

float coveredOf(Region r, vec2 lower, vec2 upper) {
  int side = sideOf(r, lower, upper);
  if (side == outside) return 0.0;
  vec2 sides = upper - lower;
  return side == inside ? sides.x * sides.y : areaWithin(r, lower, upper);
}
