// Computes the area of a list's texels under a footprint. A footprint that crosses the border of the map is split: each
// copy of the map that it touches is walked with the footprint moved, and mirrored, to the map.

// Texels [first, end) of `bins_texels`, and their tree in `bins_forest`.
struct TexelList {
  uint first;
  uint end;
  uint root;
};

// Two integers per list, first texel and root, followed by the end of the last list.
TexelList listAt(uint i) {
  return TexelList(wordAt(bins_lists, 2u * i), wordAt(bins_lists, 2u * i + 2u), wordAt(bins_lists, 2u * i + 1u));
}

// The list of a key (bin_key in inverse_map.hpp), or -1 if its bin is empty.
int listOfKey(uint key) {
  uint slots = uint(bins_hash_slots);
  uint slot = (key * 2654435769u) >> (32 - findMSB(slots));
  for (uint i = 0u; i < slots; ++i) {
    uint found = wordAt(bins_hash, 2u * slot);
    if (found == key) return int(wordAt(bins_hash, 2u * slot + 1u));
    if (found == 0xFFFFFFFFu) return -1;
    slot = (slot + 1u) & (slots - 1u);
  }
  return -1;
}
#include "atanasov_bins_region.glsl"

const uint leaf_size = 16u;

// The part of a list under a footprint.
struct ListSum {
  float area;
#if !ROUGHNESS_BIN
  vec2 offset;   // by area: offset of normals from the middle of their bin, in bins
  vec2 squares;  // by area: square of the offset
#endif
};

// The bin of a list: its middle in bins, and bins along an edge.
struct ListBin {
  vec2 middle;
  float across;
};

void addNormals(inout ListSum sum, float area, vec2 offset, float variance) {
  sum.area += area;
#if !ROUGHNESS_BIN
  sum.offset += area * offset;
  sum.squares += area * (offset * offset + variance);
#endif
}

// Adds a share of a texel.
void addTexel(inout ListSum sum, ivec2 texel, float area, ListBin bin) {
#if ROUGHNESS_BIN
  addNormals(sum, area, vec2(0.0), 0.0);
#else
  countLookups(1);
  vec2 point = (vec2(unpacked(wordOf(texelFetch(bins_map, texel, 0)))) + 0.5) / 65536.0;
  addNormals(sum, area, point * bin.across - bin.middle, 0.0);
#endif
}

// One sample in each eighth of a node's texels, in 128ths, at uneven distances because maps have patterns. The offset
// of 5 / 12 into each is its middle in the order of the tree (0.0110101... is 0.0111... and 0.1000...).
const uint samples[8] = uint[](5u, 29u, 34u, 58u, 71u, 95u, 100u, 123u);

ivec2 sampledTexel(uint begin, uint texels, int i) {
  uint place = 12u * samples[i] + 5u;
  uint at = begin + place * (texels / 1536u) + place * (texels % 1536u) / 1536u;
  return unpacked(wordAt(bins_texels, at));
}

// The share of a box about a texel's centre that a region covers, by each of its two pairs of sides.
float shareOfBox(Region r, ivec2 texel, vec2 half_sides) {
  vec2 extent = mat2(abs(r.to_unit[0]), abs(r.to_unit[1])) * half_sides;
  vec2 place = abs(r.to_unit * (vec2(texel) + 0.5 - r.centre));
  vec2 covered = clamp(0.5 + (0.5 - place) / (2.0 * extent), 0.0, 1.0);
  return covered.x * covered.y;
}

// A node that waits for sampling.
struct Counted {
  uint at;      // in the forest
  uint begin;   // of its texels
  uint texels;
  vec2 sides;   // of its rectangle
  float share;  // covered share of the rectangle
};

// One of eight samples of a node. In the order of the tree, eighths of its texels are in different parts of it.
// Therefore each sample represents texels spread evenly over a box about it, with sides of 1 / sqrt(32) of the node's.
// The more of the node the texels fill, the more evenly they cover all of it.
void addSample(inout ListSum sum, inout float share, Region r, Counted node, int i, ListBin bin) {
  ivec2 texel = sampledTexel(node.begin, node.texels, i);
  float own = node.share;
  if (abs(own - 0.5) < 0.499)
    own = mix(shareOfBox(r, texel, 0.0883883 * node.sides), own, float(node.texels) / (node.sides.x * node.sides.y));
  share += 0.125 * own;
#if !ROUGHNESS_BIN
  if (node.texels <= leaf_size) addTexel(sum, texel, 0.125 * own * float(node.texels), bin);
#endif
}

// Eight calls, because a loop would take rounds.
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
#if ROUGHNESS_BIN
  addNormals(sum, area, vec2(0.0), 0.0);
#else
  if (node.texels <= leaf_size) return;
  uint moments = wordAt(bins_moments, node.at);
  vec3 value = vec3(moments & 0xFFFu, moments >> 12 & 0xFFFu, moments >> 24) / vec3(4095.0, 4095.0, 510.0);
  addNormals(sum, area, value.xy - 0.5, value.z * value.z);
#endif
}

// A power of two. Depth-first halving of 2^28 texels down to 16, always the larger part of an odd side, takes 26 steps.
const int most_pending = 64;
const int most_counted = 32;    // nodes and texels that wait before they are added
const uint wide_node = 32768u;  // smaller nodes are one integer

// A pending node of the tree: its texels end at `end`, and its rectangle is given.
struct Node {
  uint at;
  uint end;
  ivec2 lower;
  ivec2 upper;
};

uvec4 packedNode(Node node) {
  return uvec4(node.at, node.end, node.lower.x | node.lower.y << 16, node.upper.x | node.upper.y << 16);
}
Node unpackedNode(uvec4 code) { return Node(code.x, code.y, unpacked(code.z), unpacked(code.w)); }

// Replaces a node, whose texels begin at `begin`, by its lower half, and returns the upper half.
Node upperHalfOf(inout Node node, uint begin) {
  ivec2 sides = node.upper - node.lower;
  bvec2 across = bvec2(sides.x >= sides.y, sides.x < sides.y);
  ivec2 middle = node.lower + (sides >> 1);
  uint texels = wordAt(bins_forest, node.at);
  ++node.at;
  uint tree = texels >> 16;
  if (node.end - begin < wide_node) {
    texels &= 0xFFFFu;
  } else {
    tree = wordAt(bins_forest, node.at);
    ++node.at;
  }
  Node half_node = Node(node.at + tree, node.end, mix(node.lower, middle, across), node.upper);
  node.end = begin + texels;
  node.upper = mix(node.upper, middle, across);
  return half_node;
}

// Texel i of a list as a node without a tree.
Node texelNode(uint i) {
  ivec2 texel = unpacked(wordAt(bins_texels, i));
  return Node(0u, i + 1u, texel, texel + 1);
}

// The side below which a node at the border counts by samples: a quarter of that of a square as large as the footprint.
float sampledSide(Region r) {
#if BORDER_TEXELS
  return 0.0;
#else
  return 0.25 * sqrt(areaOf(r));
#endif
}

// Whether the walk is depth first. Otherwise it visits large nodes first, so that all remaining nodes have one size
// when rounds run out. They suffice for every texel at the border at about 3 per texel of its length.
bool isDepthFirst(Region r, float rounds) {
#if BORDER_TEXELS
  return 6.0 * (length(r.edges[0]) + length(r.edges[1])) < rounds;
#else
  return false;
#endif
}

// Adds a node that waited.
void addNode(inout ListSum sum, Region r, ListBin bin, Node seen, uint begin) {
  vec2 sides = vec2(seen.upper - seen.lower);
  float share = areaWithin(r, vec2(seen.lower), vec2(seen.upper)) / (sides.x * sides.y);
  addCounted(sum, r, Counted(seen.at, begin, seen.end - begin, sides, share), bin);
}

void addOne(inout ListSum sum, Region r, ListBin bin, ivec2 texel) {
  addTexel(sum, texel, areaWithin(r, vec2(texel), vec2(texel) + 1.0), bin);
}

// Sums over one copy of the map. A round tests both halves of a node, or two texels of a leaf. Pixels that are drawn
// together wait for each other at the end of every loop, and llvmpipe takes every branch. Therefore the few nodes that
// count wait for a loop of their own. When `rounds` are down to `last`, pending nodes count by samples, two rounds
// each. `finished` becomes false if the driver ends a loop early (notWhole).
void addCopy(inout ListSum sum, Region r, TexelList list, ListBin bin, float last, inout float rounds,
             inout bool finished) {
  vec2 sampled_side = vec2(sampledSide(r));
  bool depth_first = isDepthFirst(r, rounds - last);
  Node node = Node(list.root, list.end, ivec2(0), textureSize(bins_map, 0));
  uint begin = list.first;
  uvec4 stored[most_pending + most_counted];  // a ring of pending nodes, followed by waiting ones
  uint begins[most_pending + most_counted];
  int first = 0;
  int pending = 0;
  int nodes = 0;  // waiting, from the beginning
  int texels = 0;  // from the end
  bool is_root = true;
  bool done = begin == list.end;
  while (!done) {
    while (!done && nodes + texels < most_counted - 1) {
      bool leaf = node.end - begin <= leaf_size;
      float needed = 2.0 * float(pending) + (leaf ? 1.5 * float(node.end - begin) : 4.0);
      bool spent = rounds - last < needed || pending > most_pending - 2;
      bool itself = is_root || spent;
      Node a = node;
      Node b = node;
      uint b_begin = node.end;
      if (!itself && leaf) {
        a = texelNode(begin);
        if (begin + 1u < node.end) {
          b_begin = begin + 1u;
          b = texelNode(b_begin);
        }
      } else if (!itself) {
        b = upperHalfOf(a, begin);
        b_begin = a.end;
      }
      int side_a = begin == a.end ? outside : sideOf(r, vec2(a.lower), vec2(a.upper));
      int side_b = b_begin == b.end ? outside : sideOf(r, vec2(b.lower), vec2(b.upper));
      bool ends = spent || leaf && !itself;
      bool counts_a = side_a == cut && (ends || all(lessThan(vec2(a.upper - a.lower), sampled_side)));
      bool counts_b = side_b == cut && (ends || all(lessThan(vec2(b.upper - b.lower), sampled_side)));
      bool waits_a = side_a == cut && !counts_a;
      bool waits_b = side_b == cut && !counts_b;
#if ROUGHNESS_BIN
      if (side_a == inside) sum.area += float(a.end - begin);
      if (side_b == inside) sum.area += float(b.end - b_begin);
#else
      counts_a = counts_a || side_a == inside;
      counts_b = counts_b || side_b == inside;
#endif
      bool are_texels = leaf && !itself;
      int aside = most_pending + (are_texels ? most_counted - 1 - texels : nodes);
      int slot_b = counts_b ? aside : (first + pending) & (most_pending - 1);
      if (counts_b) aside += are_texels ? -1 : 1;
      if (waits_b) ++pending;
      int slot_a = counts_a ? aside : (first + pending) & (most_pending - 1);
      if (are_texels) texels += int(counts_a) + int(counts_b);
      else nodes += int(counts_a) + int(counts_b);
      if (waits_a) ++pending;
      if (counts_b || waits_b) {
        stored[slot_b] = packedNode(b);
        begins[slot_b] = b_begin;
      }
      if (counts_a || waits_a) {
        stored[slot_a] = packedNode(a);
        begins[slot_a] = begin;
      }
      rounds -= 1.0 + float(counts_a) + float(counts_b);
      begin += 2u;
      if (itself || !leaf || begin >= node.end) {
        done = pending == 0;
        int slot = depth_first ? (first + pending - 1) & (most_pending - 1) : first;
        if (!depth_first) first = (first + 1) & (most_pending - 1);
        node = unpackedNode(stored[slot]);
        begin = begins[slot];
        --pending;
      }
      is_root = false;
    }
    for (; nodes > 0; --nodes) {
      int i = most_pending + nodes - 1;
      addNode(sum, r, bin, unpackedNode(stored[i]), begins[i]);
    }
    for (; texels > 0; --texels) addOne(sum, r, bin, unpacked(stored[most_pending + most_counted - texels].z));
  }
  finished = finished && done && nodes + texels == 0;
}

// The first and the last copy of the map along an axis; a single one if it does not repeat.
ivec2 copiesAlong(float centre, float reach, float size, float wrap) {
  if (wrap == 2.0) return ivec2(0);
  return ivec2(int(floor((centre - reach) / size)), int(ceil((centre + reach) / size)) - 1);
}

// A region relative to copy (x, y) of the map; wrap 1 mirrors every other copy.
Region inCopy(Region r, ivec2 copy) {
  vec2 size = mapSize();
  r.centre -= vec2(copy) * size;
  vec2 mirrored = vec2(equal(vec2(bins_wrap_u, bins_wrap_v), vec2(1.0))) * vec2(copy & 1);
  vec2 turn = 1.0 - 2.0 * mirrored;
  r.centre = mix(r.centre, size - r.centre, mirrored);
  r.edges = mat2(r.edges[0] * turn, r.edges[1] * turn);
  r.to_unit = mat2(r.to_unit[0] * turn.x, r.to_unit[1] * turn.y);
  return r;
}

// Sums a list with at most `rounds` rounds of loops, which copies of the map share, plus a few for each copy.
ListSum sumOfList(Region r, TexelList list, ListBin bin, float rounds, inout bool finished) {
#if ROUGHNESS_BIN
  ListSum sum = ListSum(0.0);
#else
  ListSum sum = ListSum(0.0, vec2(0.0), vec2(0.0));
#endif
  vec2 size = mapSize();
  ivec2 columns = copiesAlong(r.centre.x, r.reach.x, size.x, bins_wrap_u);
  ivec2 rows = copiesAlong(r.centre.y, r.reach.y, size.y, bins_wrap_v);
  int columns_count = max(columns.y - columns.x + 1, 1);
  int copies = columns_count * max(rows.y - rows.x + 1, 1);
  int seen = 0;
  for (int i = 0; i < copies; ++i) {
    ++seen;
    ivec2 copy = ivec2(columns.x + i % columns_count, rows.x + i / columns_count);
    rounds -= 3.0;
    float last = rounds * (1.0 - 1.0 / float(copies - i));
    addCopy(sum, inCopy(r, copy), list, bin, last, rounds, finished);
  }
  finished = finished && seen >= copies;
  return sum;
}
