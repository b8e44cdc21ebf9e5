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

ivec2 texelAt(Region r, vec2 point) { return ivec2(floor(r.centre + r.edges * (point - 0.5))); }

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

//? include atanasov_bins_beyond.glsl
//? if roughness_bin
//? include atanasov_bins_bins.glsl
//? else
//? include atanasov_bins_lobes.glsl
//? end

// Texels that are looked at one by one for less than the walks of so many lists, which take some 64 steps each.
float texelsWorth(float lists, float rounds) { return min(64.0 * lists, texelRounds(rounds)); }

// The mean over the footprint; over nothing but texels without a normal that of the surface's own.
float meanValue(Effective e, Query q) {
//? if roughness_bin
  countLobes(1);
//? end
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
