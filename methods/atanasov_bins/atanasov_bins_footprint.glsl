// All texels under a footprint: of a small one each by itself, from the bin map; of a large one by bins, from the
// inverse bin map, whose trees count them.
//? include atanasov_bins_walk.glsl

struct Effective {
  Footprint footprint;
  float variance;  // of the base lobe
//? if diffuse
  vec3 mean;       // of the normals
//? end
//? if environment_light
  float drawn;     // the share of what is drawn that has a normal
//? end
};

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

// Whether the box about a region has no more texels than that.
bool hasAtMost(Region r, float most_texels) {
  vec2 sides = 2.0 * r.reach + 1.0;
  return sides.x * sides.y <= most_texels;
}

ivec2 texelIn(TexelBox box, int i) {
  int row = int((float(i) + 0.5) / float(box.across));
  return box.first + ivec2(i - row * box.across, row);
}

// Of any copy of the map: the sampler wraps.
uint packedAt(ivec2 texel) {
  countLookups(1);
  return wordOf(textureLod(bins_map, (vec2(texel) + 0.5) / mapSize(), 0.0));
}

float areaOfTexel(Region r, ivec2 texel) { return coveredOf(r, vec2(texel), vec2(texel) + 1.0); }

// Sums over a region: of values by area, and of the area that has normals.
struct Sum {
  float value;
  float area;
};

// llvmpipe ends all loops of a pixel after 65535 rounds: no picture may pass for whole then.
Sum notWhole() {
  float no_number = uintBitsToFloat(0x7fc00000u);
  return Sum(no_number, no_number);
}

//? if roughness_lobe and roughness_variation
// The roughness map's texels that a texel of the normal map lies on; the footprint's mean where the two maps are not
// looked up alike.
float varianceAt(Effective e, ivec2 texel) {
  if (bins_own_roughness == 0.0) return e.variance;
  countLookups(1);
  float level = max(log2(float(textureSize(lobe_variance, 0).x) / mapSize().x), 0.0);
  return textureLod(lobe_variance, (vec2(texel) + 0.5) / mapSize(), level).r * stored_lobe_variance;
}

// What the spread of a list (listNormal) has not in it.
float varianceOfLists(Effective e) { return bins_own_roughness == 0.0 ? e.variance : 0.0; }
//? else
float varianceAt(Effective e, ivec2 texel) { return e.variance; }
float varianceOfLists(Effective e) { return e.variance; }
//? end

float texelValue(Effective e, ivec2 texel, uint code, Query q) {
//? if roughness_bin
  return binOfPacked(code) == q.bin ? 1.0 / binSolidAngle() : 0.0;
//? else
  return valueAbout(varianceAt(e, texel), unpackedNormal(code), 0.0, q);
//? end
}

Sum sumOfTexels(Effective e, Region r, Query q) {
  Sum sum = Sum(0.0, 0.0);
  TexelBox box = texelsAbout(r);
  int seen = 0;  // of the loop's own counter the compiler knows what it is behind the loop
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

// What is to be counted: lists, one after the other, and what a texel of each is worth.
struct Lists {
  int count;
//? if not roughness_bin
  bool all;         // of the map, else those of a block of cells
  ivec2 lower;      // the block
  int across;
  float farthest;   // 1 - cos of the angle beyond which no lobe reaches h
//? end
};

//? if roughness_bin
Lists listsFor(Effective e, Query q) { return Lists(1); }

int listIn(Lists lists, int i, Effective e, Query q, out float value) {
  value = 1.0 / binSolidAngle();
  return listOfBin(q.bin);
}
//? else
// The angle beyond which a lobe is below 1e-4 of its peak: where 1 - cos is 4.6 alpha^2 (a ten-thousandth of a Gaussian
// lobe lies beyond), or, of GGX's tails, the tangent 9.95 alpha (a hundredth does).
float lobeReach(float variance) {
  float alpha = sqrt(2.0 * variance);
//? if distribution_ggx and roughness_lobe
  return atan(9.95 * alpha);
//? else
  return 2.0 * asin(min(sqrt(2.3) * alpha, 1.0));
//? end
}

// Cells along an axis of the square that a cap of this angle about h may reach to either side. On the disc of radius
// sqrt(1 - cos t) lengths grow by no more than 1 / (sqrt(2) cos(t / 2)), from there to the square by no more than
// sqrt(1 + (4 / pi)^2) / 2.
float cellsOfCap(vec3 h, float angle) {
  float rim = min(acos(clamp(h.z, -1.0, 1.0)) + angle, 0.5 * pi);
  return bins_across * angle * 0.8096 / (sqrt(2.0) * cos(0.5 * rim));
}

// The angle to the normal beyond which none of the lobes reaches: those of a material's own have axes of their own.
float farthestReach(float variance) {
//? if multi_lobe and roughness_lobe
  float reach = 0.0;
  for (int k = 0; k < facet_lobe_count; ++k) {
    float tilt = acos(clamp(facet_lobes[k].axis.z, -1.0, 1.0));
    reach = max(reach, tilt + lobeReach(facet_lobes[k].variance + bins_spread));
  }
  if (facet_lobe_count > 0) return reach;
//? end
  return lobeReach(variance + bins_spread);
}

// Those whose lobes reach h: of the cells about it or, where these are more than there are lists, all.
Lists listsFor(Effective e, Query q) {
  float reach = farthestReach(varianceOfLists(e));
  vec2 middle = hemisphereToSquare(q.h) * bins_across;
  float cells = cellsOfCap(q.h, reach + 1.8 / bins_across);  // and half of a bin's own diagonal
  ivec2 lower = ivec2(max(floor(middle - cells), 0.0));
  ivec2 sides = ivec2(min(floor(middle + cells), bins_across - 1.0)) - lower + 1;
  bool all_lists = float(sides.x * sides.y) >= bins_list_count;
  int count = all_lists ? int(bins_list_count) : sides.x * sides.y;
//? if distribution_ggx and roughness_lobe
  if (all_lists) reach = pi;  // no tail is cut off that is looked at anyway
//? end
  return Lists(count, all_lists, lower, sides.x, 1.0 - cos(min(reach, pi)));
}

// Mean normal and spread of a list.
vec4 listNormal(int list) {
  countLookups(1);
  int columns = textureSize(bins_normals, 0).x;
  return texelFetch(bins_normals, ivec2(list & (columns - 1), list >> findMSB(columns)), 0);
}

int listIn(Lists lists, int i, Effective e, Query q, out float value) {
  int row = int((float(i) + 0.5) / float(lists.across));
  int list = lists.all ? i : listOfBin(binIn(lists.lower + ivec2(i - row * lists.across, row)));
  value = 0.0;
  if (list < 0) return list;
  vec4 normal = listNormal(list);
  if (oneMinusDot(normal.xyz, q.h) > lists.farthest) return -1;
  value = valueAbout(varianceOfLists(e), normal.xyz, normal.w, q);
  return list;
}
//? end

// Texels that are looked at one by one for less than the walks of so many lists, which take some 64 steps each.
float texelsWorth(Lists lists) { return min(64.0 * float(lists.count), 4096.0); }

// The texels without a normal are a list too, which takes from the area.
Sum sumOfLists(Effective e, Region r, Lists lists, Query q) {
  bool finished = true;
  Sum sum = Sum(0.0, areaOf(r));
  int first = bins_invalid_list < 0.0 ? 0 : -1;
  int seen = first;
  for (int i = first; i < lists.count; ++i) {
    ++seen;
    float value = 0.0;
    int list = i < 0 ? int(bins_invalid_list) : listIn(lists, i, e, q, value);
    if (list < 0) continue;
    float area = areaOfList(r, listAt(uint(list)), finished);
    if (i < 0) {
      sum.area -= area;
    } else {
      sum.value += area * value;
    }
  }
  if (sum.area < 1e-4 * areaOf(r)) sum = Sum(0.0, 0.0);
  return finished && seen >= lists.count ? sum : notWhole();
}

// The mean over the footprint; over nothing but texels without a normal that of the surface's own.
float meanValue(Effective e, Query q) {
//? if roughness_bin
  countLobes(1);
//? end
  Sum sum = Sum(0.0, 0.0);
  Lists lists = listsFor(e, q);
  int count = regionCount(e.footprint);
  int i = 0;
  do {
    Region r = regionAt(e.footprint, i);
    if (r.weight <= 0.0) continue;
    Sum part;
    if (hasAtMost(r, texelsWorth(lists))) {
      part = sumOfTexels(e, r, q);
    } else {
      part = sumOfLists(e, r, lists, q);
    }
    float weight = r.weight / areaOf(r);
    sum.value += weight * part.value;
    sum.area += weight * part.area;
  } while (++i < count);
  if (sum.area == 0.0) {
//? if roughness_bin
    sum = Sum(q.bin == binOfPacked(up_code) ? 1.0 / binSolidAngle() : 0.0, 1.0);
//? else
    sum = Sum(valueAbout(e.variance, vec3(0.0, 0.0, 1.0), 0.0, q), 1.0);
//? end
  }
  return finishedValue(e.variance, sum.value / sum.area, q);
}

//? if diffuse
// Of the texels under a small region: the sum of their normals by area, and the area that has normals.
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

// For the diffuse term: of a small footprint from its texels, of a large one from a mip chain of means that begins at
// the level of 4 x 4 texels.
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
//? end

//? if environment_light
//? include atanasov_bins_draws.glsl
//? end

Effective effective(Footprints f) {
  Effective e;
  e.footprint = f.normal;
  e.variance = baseVariance(f);
//? if diffuse
  e.mean = meanUnder(f.normal);
//? end
//? if environment_light
  e.drawn = drawnShare(e);
//? end
  return e;
}
