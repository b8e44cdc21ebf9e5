// What a walk adds of a list: nodes and texels, by what of them is covered and by their normals.
//? include atanasov_bins_lists.glsl
//? include atanasov_bins_region.glsl

const uint leaf_size = 16u;

// What lies of a list under a footprint.
struct ListSum {
  float area;
//? if not roughness_bin
  vec2 offset;   // by area: where normals lie in their bin, from its middle, in bins
  vec2 squares;  // by area: of that
//? end
};

// The bin of a list: its middle, in bins, and bins along an edge.
struct ListBin {
  vec2 middle;
  float across;
};

void addNormals(inout ListSum sum, float area, vec2 offset, float variance) {
  sum.area += area;
//? if not roughness_bin
  sum.offset += area * offset;
  sum.squares += area * (offset * offset + variance);
//? end
}

// Adds a share of a texel.
void addTexel(inout ListSum sum, ivec2 texel, float area, ListBin bin) {
//? if roughness_bin
  addNormals(sum, area, vec2(0.0), 0.0);
//? else
  countLookups(1);
  vec2 point = (vec2(unpacked(wordOf(texelFetch(bins_map, texel, 0)))) + 0.5) / 65536.0;
  addNormals(sum, area, point * bin.across - bin.middle, 0.0);
//? end
}

// One of each eighth of a node's texels, in 128ths, at uneven distances, as maps have patterns; 5 / 12 into each, which in
// the tree's order is its middle: 0.0110101... has the coordinates 0.0111... and 0.1000..., whose digits it has in turns.
const uint samples[8] = uint[](5u, 29u, 34u, 58u, 71u, 95u, 100u, 123u);

ivec2 sampledTexel(uint begin, uint texels, int i) {
  uint place = 12u * samples[i] + 5u;
  uint at = begin + place * (texels / 1536u) + place * (texels % 1536u) / 1536u;
  return unpacked(wordAt(bins_texels, at));
}

// The share that a region covers of a box about a texel's centre, by each of its two pairs of sides.
float shareOfBox(Region r, ivec2 texel, vec2 half_sides) {
  vec2 extent = mat2(abs(r.to_unit[0]), abs(r.to_unit[1])) * half_sides;
  vec2 place = abs(r.to_unit * (vec2(texel) + 0.5 - r.centre));
  vec2 covered = clamp(0.5 + (0.5 - place) / (2.0 * extent), 0.0, 1.0);
  return covered.x * covered.y;
}

// A node that is put aside.
struct Counted {
  uint at;      // in the forest
  uint begin;   // of its texels
  uint texels;
  vec2 sides;   // of its rectangle
  float share;  // of that which is covered
};

// One of eight samples of a node. In the tree's order eighths of its texels lie in different parts of it, so each stands
// for texels that are spread evenly over a box about it, whose sides are 1 / sqrt(32) of the node's. The more of the
// node the texels fill, the more they are spread evenly over all of it.
void addSample(inout ListSum sum, inout float share, Region r, Counted node, int i, ListBin bin) {
  ivec2 texel = sampledTexel(node.begin, node.texels, i);
  float own = node.share;
  if (abs(own - 0.5) < 0.499)
    own = mix(shareOfBox(r, texel, 0.0883883 * node.sides), own, float(node.texels) / (node.sides.x * node.sides.y));
  share += 0.125 * own;
//? if not roughness_bin
  if (node.texels <= leaf_size) addTexel(sum, texel, 0.125 * own * float(node.texels), bin);
//? end
}

// Eight calls: a loop would take rounds.
void addCounted(inout ListSum sum, Region r, Counted node, ListBin bin) {
  float share = 0.0;
  addSample(sum, share, r, node, 0, bin);
  addSample(sum, share, r, node, 1, bin);
  addSample(sum, share, r, node, 2, bin);
  addSample(sum, share, r, node, 3, bin);
  addSample(sum, share, r, node, 4, bin);
  addSample(sum, share, r, node, 5, bin);
  addSample(sum, share, r, node, 6, bin);
  addSample(sum, share, r, node, 7, bin);
  float area = share * float(node.texels);
//? if roughness_bin
  addNormals(sum, area, vec2(0.0), 0.0);
//? else
  if (node.texels <= leaf_size) return;
  uint moments = wordAt(bins_moments, node.at);
  vec3 value = vec3(moments & 0xFFFu, moments >> 12 & 0xFFFu, moments >> 24) / vec3(4095.0, 4095.0, 510.0);
  addNormals(sum, area, value.xy - 0.5, value.z * value.z);
//? end
}
