// Sums the texels under a footprint: one by one if it is small, otherwise by bins, whose trees count texels.
#include "atanasov_bins_walk.glsl"

struct Effective {
  Footprint footprint;
  float variance;  // of the base lobe
#if DIFFUSE
  vec3 mean;       // of the normals
#endif
#if LOBES_LISTED
  float drawn;     // the share of drawn texels that have a normal
#endif
};

// Texels, or cells of the square, row by row.
struct TexelBox {
  ivec2 first;
  int across;
  int count;
};

TexelBox texelsAbout(Region r) {
  ivec2 first = ivec2(floor(r.centre - r.reach));
  ivec2 sides = ivec2(ceil(r.centre + r.reach)) - first;
  return TexelBox(first, sides.x, sides.x * sides.y);
}

// Whether the box about a region has at most `most_texels` texels.
bool hasAtMost(Region r, float most_texels) {
  vec2 sides = 2.0 * r.reach + 1.0;
  return sides.x * sides.y <= most_texels;
}

ivec2 texelIn(TexelBox box, int i) {
  int row = int((float(i) + 0.5) / float(box.across));
  return box.first + ivec2(i - row * box.across, row);
}

// The packed normal of a texel of any copy of the map; the sampler wraps.
uint packedAt(ivec2 texel) {
  countLookups(1);
  return wordOf(textureLod(bins_map, (vec2(texel) + 0.5) / mapSize(), 0.0));
}

ivec2 texelAt(Region r, vec2 point) { return ivec2(floor(r.centre + r.edges * (point - 0.5))); }

float areaOfTexel(Region r, ivec2 texel) { return coveredOf(r, vec2(texel), vec2(texel) + 1.0); }

// Sums over a region: values by area, and the area that has normals.
struct Sum {
  float value;
  float area;
};

// The result of an incomplete sum: not a number, because Mesa 22.3's llvmpipe ends all loops of a pixel after 65535
// rounds and no incomplete image must pass unnoticed.
Sum notWhole() {
  float no_number = uintBitsToFloat(0x7fc00000u);
  return Sum(no_number, no_number);
}

#if ROUGHNESS_LOBE && ROUGHNESS_VARIATION
// The variance of the roughness texels under a texel; the footprint's mean if the maps have different coordinates.
float varianceAt(Effective e, ivec2 texel) {
  if (bins_own_roughness == 0.0) return e.variance;
  countLookups(1);
  float level = max(log2(float(textureSize(lobe_variance, 0).x) / mapSize().x), 0.0);
  return textureLod(lobe_variance, (vec2(texel) + 0.5) / mapSize(), level).r * stored_lobe_variance;
}

// The variance of a list that its spread does not include.
float varianceOfLists(Effective e) { return bins_own_roughness == 0.0 ? e.variance : 0.0; }
#else
float varianceAt(Effective e, ivec2 texel) { return e.variance; }
float varianceOfLists(Effective e) { return e.variance; }
#endif

float texelValue(Effective e, ivec2 texel, uint code, Query q) {
#if ROUGHNESS_BIN
  return binOfPacked(code) == q.bin ? 1.0 / binSolidAngle() : 0.0;
#else
  return valueAbout(varianceAt(e, texel), unpackedNormal(code), 0.0, q);
#endif
}

Sum sumOfTexels(Effective e, Region r, Query q) {
  Sum sum = Sum(0.0, 0.0);
  TexelBox box = texelsAbout(r);
  int seen = 0;  // the compiler would assume the final value of the loop's own counter
  for (int i = 0; i < box.count; ++i) {
    ++seen;
    ivec2 texel = texelIn(box, i);
    float area = areaOfTexel(r, texel);
    if (area <= 0.0) continue;
    uint code = packedAt(texel);
    if (code == no_normal) continue;
    sum.value += area * texelValue(e, texel, code, q);
    sum.area += area;
  }
  return seen < box.count ? notWhole() : sum;
}

// A footprint that reaches beyond a map that does not repeat. The outermost texels continue there.

bvec2 endsAlong() { return equal(vec2(bins_wrap_u, bins_wrap_v), vec2(2.0)); }

bool isBeyond(ivec2 texel) {
  bvec2 outer = bvec2(texel.x < 0 || texel.x >= int(mapSize().x), texel.y < 0 || texel.y >= int(mapSize().y));
  return outer.x && endsAlong().x || outer.y && endsAlong().y;
}

// The rectangle of a region that the map covers. Along an axis that repeats it is the whole region.
vec4 mapUnder(Region r) {
  vec2 lower = r.centre - r.reach;
  vec2 upper = r.centre + r.reach;
  return vec4(mix(lower, clamp(lower, vec2(0.0), mapSize()), endsAlong()),
              mix(upper, clamp(upper, vec2(0.0), mapSize()), endsAlong()));
}

float areaOnMap(Region r) {
  vec4 map = mapUnder(r);
  return any(endsAlong()) ? coveredOf(r, map.xy, map.zw) : areaOf(r);
}

void addPiece(inout Sum sum, Effective e, Region r, Query q, vec2 lower, vec2 upper, vec2 place) {
  if (any(greaterThanEqual(lower, upper))) return;
  float area = coveredOf(r, lower, upper);
  ivec2 texel = ivec2(floor(place));  // the sampler clamps it to the map
  uint code = packedAt(texel);
  if (area <= 0.0 || code == no_normal) return;
  sum.value += area * texelValue(e, texel, code, q);
  sum.area += area;
}

// One piece for every texel along the map's edges and one beyond each corner. If there are too many texels for the
// rounds, a piece covers several and counts as the texel in its middle.
Sum sumBeyond(Effective e, Region r, Query q, float rounds, inout bool finished) {
  Sum sum = Sum(0.0, 0.0);
  if (!any(endsAlong())) return sum;
  vec2 lower = r.centre - r.reach;
  vec2 upper = r.centre + r.reach;
  vec4 map = mapUnder(r);
  vec2 first = floor(map.xy);
  vec2 count = min(ceil(map.zw) - first, clamp(floor(0.004 * rounds), 1.0, 256.0));
  vec2 each = (ceil(map.zw) - first) / count;
  int pieces = int(max(count.x, count.y)) + 2;
  int seen = 0;
  for (int i = 0; i < pieces; ++i) {
    ++seen;
    // One piece of each edge along x and y. The first two rounds add the corners, which are beyond both.
    vec2 begin = first + float(i - 2) * each;
    vec2 end = begin + each;
    vec2 middle = begin + 0.5 * each;
    bvec2 is_along = lessThan(vec2(i - 2), count);
    if (i < 2) {
      begin.x = i == 0 ? lower.x : map.z;
      end.x = i == 0 ? map.x : upper.x;
      middle.x = 0.5 * (begin.x + end.x);
      is_along = bvec2(true, false);
    }
    if (is_along.x) {
      addPiece(sum, e, r, q, vec2(begin.x, lower.y), vec2(end.x, map.y), vec2(middle.x, 0.5 * (lower.y + map.y)));
      addPiece(sum, e, r, q, vec2(begin.x, map.w), vec2(end.x, upper.y), vec2(middle.x, 0.5 * (map.w + upper.y)));
    }
    if (is_along.y) {
      addPiece(sum, e, r, q, vec2(lower.x, begin.y), vec2(map.x, end.y), vec2(0.5 * (lower.x + map.x), middle.y));
      addPiece(sum, e, r, q, vec2(map.z, begin.y), vec2(upper.x, end.y), vec2(0.5 * (map.z + upper.x), middle.y));
    }
  }
  finished = finished && seen == pieces;
  return sum;
}
#if ROUGHNESS_BIN
// A bin's density over a large footprint: its list's share of the area, less that of the list without normals.
float listCount(Effective e, Query q, float rounds) { return 1.0; }

Sum sumOfLists(Effective e, Region r, Query q, float rounds) {
  bool finished = true;
  Sum sum = sumBeyond(e, r, q, rounds, finished);
  sum.area += areaOnMap(r);
  float walk = walkRounds(rounds, bins_invalid_list < 0.0 ? 1.0 : 2.0);
  int i = bins_invalid_list < 0.0 ? 1 : 0;
  do {
    int list = i == 0 ? int(bins_invalid_list) : listOfKey(q.bin);
    ++i;
    if (list < 0) continue;
    ListSum part = sumOfList(r, listAt(uint(list)), ListBin(vec2(0.0), 1.0), walk, finished);
    if (i == 1) sum.area -= part.area;
    else sum.value += part.area / binSolidAngle();
  } while (i < 2);
  if (sum.area < 1e-4 * areaOf(r)) sum = Sum(0.0, 0.0);
  return finished && i == 2 ? sum : notWhole();
}
#else
#include "atanasov_bins_lobes.glsl"
#endif

// The most texels that are looked up one by one: less than walking `lists` lists costs, with about 64 steps each.
float texelsWorth(float lists, float rounds) { return min(64.0 * lists, texelRounds(rounds)); }

// The mean over the footprint. If all texels lack a normal it is that of a flat surface.
float meanValue(Effective e, Query q) {
#if ROUGHNESS_BIN
  countLobes(1);
#endif
  Sum sum = Sum(0.0, 0.0);
  int count = regionCount(e.footprint);
  float rounds = regionRounds(count);
  float lists = listCount(e, q, rounds);
  int i = 0;
  do {
    Region r = regionAt(e.footprint, i);
    if (r.weight <= 0.0) continue;
    Sum part;
    if (hasAtMost(r, texelsWorth(lists, rounds))) {
      part = sumOfTexels(e, r, q);
    } else {
      part = sumOfLists(e, r, q, rounds);
    }
    float weight = r.weight / areaOf(r);
    sum.value += weight * part.value;
    sum.area += weight * part.area;
  } while (++i < count);
  if (sum.area == 0.0) {
#if ROUGHNESS_BIN
    sum = Sum(q.bin == binOfPacked(up_code) ? 1.0 / binSolidAngle() : 0.0, 1.0);
#else
    sum = Sum(valueAbout(e.variance, vec3(0.0, 0.0, 1.0), 0.0, q), 1.0);
#endif
  }
  return finishedValue(e.variance, sum.value / sum.area, q);
}

#if DIFFUSE
// Over the texels under a small region: the sum of their normals by area, and the area that has normals.
vec4 sumOfNormals(Region r) {
  vec4 sum = vec4(0.0);
  TexelBox box = texelsAbout(r);
  for (int i = 0; i < box.count; ++i) {
    ivec2 texel = texelIn(box, i);
    float area = areaOfTexel(r, texel);
    uint code = area > 0.0 ? packedAt(texel) : no_normal;
    if (code != no_normal) sum += area * vec4(unpackedNormal(code), 1.0);
  }
  return sum;
}

// The mean normal for the diffuse term: of a small footprint's texels, or from means of 4 x 4 texels and more.
vec3 meanUnder(Footprint f) {
  vec4 sum = vec4(0.0);
  int count = regionCount(f);
  for (int i = 0; i < count; ++i) {
    Region r = regionAt(f, i);
    if (r.weight <= 0.0) continue;
    if (!hasAtMost(r, 256.0)) return fetch(bins_mean_normal, f).xyz;
    sum += r.weight / areaOf(r) * sumOfNormals(r);
  }
  return sum.w > 0.0 ? sum.xyz / sum.w : vec3(0.0, 0.0, 1.0);
}

vec3 meanNormal(Effective e) { return e.mean; }
#endif

#if LOBES_LISTED
// Draws texels under a footprint (section 2.1) at points that fill it evenly; few texels count by their areas.

// All regions share the draws.
int drawsEach(Footprint f) { return max(int(option_draws) / regionCount(f), 1); }

DrawnTexel drawnUnder(Effective e, int i) {
  int each = drawsEach(e.footprint);
  int own = i % each;
  Region r = regionAt(e.footprint, i / each);
  TexelBox box = texelsAbout(r);
  ivec2 texel = texelAt(r, evenPoint(i).xy);
  float share = 1.0 / float(each);
  if (box.count <= each) {
    texel = texelIn(box, own);
    share = own < box.count ? areaOfTexel(r, texel) / areaOf(r) : 0.0;
  }
  uint code = packedAt(texel);
  return DrawnTexel(code, varianceAt(e, texel), code == no_normal ? 0.0 : r.weight * share);
}

int drawCount(Effective e) { return regionCount(e.footprint) * drawsEach(e.footprint); }

// The share of draws that have a normal.
float drawnShare(Effective e) {
  if (bins_invalid_list < 0.0) return 1.0;
  float share = 0.0;
  int count = drawCount(e);
  for (int i = 0; i < count; ++i) share += drawnUnder(e, i).share;
  return share;
}

// A drawn texel; the surface's own normal if no draw has one.
DrawnTexel drawnTexel(Effective e, int i) {
  if (e.drawn <= 0.0) return DrawnTexel(up_code, e.variance, 1.0 / float(drawCount(e)));
  DrawnTexel texel = drawnUnder(e, i);
  texel.share /= e.drawn;
  return texel;
}
#endif

Effective effective(Footprints f) {
  Effective e;
  e.footprint = f.normal;
  e.variance = baseVariance(f);
#if DIFFUSE
  e.mean = meanUnder(f.normal);
#endif
#if LOBES_LISTED
  e.drawn = drawnShare(e);
#endif
  return e;
}
