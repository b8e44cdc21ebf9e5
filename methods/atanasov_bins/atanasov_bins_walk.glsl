// The area of a list's texels under a footprint. A footprint that reaches over the map's border is taken apart: each
// copy of the map that it touches is walked with the footprint moved, and mirrored, to where the map is.
//? include atanasov_bins_counted.glsl

// Depth first, halving 2^28 texels down to 16, an odd side's longer part each time, takes 26 steps.
const int most_pending = 64;
const int most_counted = 64;  // that are put aside before they are added
const uint wide_node = 32768u;  // nodes of fewer texels are one integer

// How far the outermost texels go on beyond the map that does not repeat: lower and upper edges.
vec4 beyondMap(Region r) {
  vec2 size = mapSize();
  vec4 beyond = max(vec4(r.reach - r.centre, r.centre + r.reach - size), 0.0);
  vec2 clamped = vec2(equal(vec2(bins_wrap_u, bins_wrap_v), vec2(2.0)));
  return beyond * clamped.xyxy;
}

// A box of texels, the border's widened.
vec4 boxOf(ivec2 lower, ivec2 upper, vec4 beyond) {
  ivec2 size = textureSize(bins_map, 0);
  vec2 from = vec2(lower) - beyond.xy * vec2(equal(lower, ivec2(0)));
  return vec4(from, vec2(upper) + beyond.zw * vec2(equal(upper, size)));
}

// What is left to be looked at: a node of the tree, its texels up to `end`, its rectangle.
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

// Makes a node, whose texels begin at `begin`, its lower half; the upper half comes back.
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

// Texel i of a list, as a node that has no tree.
Node texelNode(uint i) {
  ivec2 texel = unpacked(wordAt(bins_texels, i));
  return Node(0u, i + 1u, texel, texel + 1);
}

// Sides below which a node that the border cuts counts by samples: a quarter of the side of a square as large as the
// footprint.
float evenSide(Region r) {
//? if border_texels
  return 0.0;
//? else
  return 0.25 * sqrt(areaOf(r));
//? end
}

// Rounds are spent on large nodes first, so that all that is left where they end is of one size. Only where they are
// enough for every texel at the border, some 6 for a texel of its length, nothing but a stack is needed.
bool isDepthFirst(Region r, float rounds) {
//? if border_texels
  return 12.0 * (length(r.edges[0]) + length(r.edges[1])) < rounds;
//? else
  return false;
//? end
}

bool isOutside(Region r, Node node, uint begin, vec4 beyond) {
  vec4 box = boxOf(node.lower, node.upper, beyond);
  return begin == node.end || sideOf(r, box.xy, box.zw) == outside;
}

// A node or a texel that was put aside, in place of whose `end` is the number of texels.
void addPutAside(inout ListSum sum, Region r, vec4 beyond, ListBin bin, Node seen, uint begin) {
  vec4 box = boxOf(seen.lower, seen.upper, beyond);
  bool whole = sideOf(r, box.xy, box.zw) == inside;
  addCounted(sum, r, Counted(seen.at, begin, seen.end, box, whole), vec2(seen.upper - seen.lower), bin);
}

// Over one copy of the map. One loop looks at nodes and at the texels of leaves alike: pixels that are drawn together
// wait for each other at the end of every loop, and llvmpipe takes every branch. So what counts, a few of many, is put
// aside for a loop of its own. Where `rounds` are down to `last` what is pending counts by samples, two rounds each.
// `finished` becomes false where the driver has ended a loop before its end (notWhole).
void addCopy(inout ListSum sum, Region r, TexelList list, ListBin bin, float last, inout float rounds,
             inout bool finished) {
  vec4 beyond = beyondMap(r);
  float even_side = evenSide(r);
  bool depth_first = isDepthFirst(r, rounds - last);
  Node node = Node(list.root, list.end, ivec2(0), textureSize(bins_map, 0));
  uint begin = list.first;
  uvec4 kept[most_pending + most_counted];  // a ring of nodes that are left to be looked at, then what is put aside
  uint begins[most_pending + most_counted];
  int first = 0;
  int pending = 0;
  int counted = 0;
  bool in_leaf = false;
  bool done = false;
  while (!done) {
    while (!done && counted < most_counted) {
      Node seen = node;
      if (in_leaf) seen = texelNode(begin);
      uint texels = seen.end - begin;
      vec4 box = boxOf(seen.lower, seen.upper, beyond);
      vec2 sides = box.zw - box.xy;
      // Texels that go on beyond the map are larger than others: none stands for another.
      bool goes_on = any(greaterThan(sides, vec2(seen.upper - seen.lower)));
      int side = sideOf(r, box.xy, box.zw);
      if (goes_on && side == inside) side = cut;
      // Two rounds for all that is pending and, of a leaf, for each of its texels.
      float needed = float(2 * (pending + (texels > leaf_size ? 2 : int(texels))));
      bool spent = rounds - last < needed || pending > most_pending - 2;
      bool counts = side == cut && (in_leaf || spent || !goes_on && all(lessThan(sides, vec2(even_side))));
      bool splits = side == cut && !counts && texels > leaf_size;
      bool leaf = side == cut && !counts && !splits;
//? if roughness_bin
      if (side == inside) sum.area += float(texels);
//? else
      counts = counts || side == inside;
//? end
      rounds -= counts ? 2.0 : 1.0;
      if (counts) {
        kept[most_pending + counted] = packedNode(Node(seen.at, texels, seen.lower, seen.upper));
        begins[most_pending + counted] = begin;
        ++counted;
      }
      if (splits) {
        Node upper = upperHalfOf(node, begin);
        int slot = (first + pending) & (most_pending - 1);
        kept[slot] = packedNode(upper);
        begins[slot] = node.end;
        if (!isOutside(r, upper, node.end, beyond)) ++pending;
        slot = (first + pending) & (most_pending - 1);
        kept[slot] = packedNode(node);
        begins[slot] = begin;
        if (!isOutside(r, node, begin, beyond)) ++pending;
      } else if (!leaf) {
        begin += texels;
      }
      in_leaf = in_leaf || leaf;
      if (splits || begin == node.end) {
        in_leaf = false;
        done = pending == 0;
        int slot = depth_first ? (first + pending - 1) & (most_pending - 1) : first;
        if (!depth_first) first = (first + 1) & (most_pending - 1);
        node = unpackedNode(kept[slot]);
        begin = begins[slot];
        --pending;
      }
    }
    for (; counted > 0; --counted) {
      int i = most_pending + counted - 1;
      addPutAside(sum, r, beyond, bin, unpackedNode(kept[i]), begins[i]);
    }
  }
  finished = finished && done && counted == 0;
}

// Copies of the map along an axis: first and last; one where it does not repeat.
ivec2 copiesAlong(float centre, float reach, float size, float wrap) {
  if (wrap == 2.0) return ivec2(0);
  return ivec2(int(floor((centre - reach) / size)), int(ceil((centre + reach) / size)) - 1);
}

// A region as copy (x, y) of the map sees it: 1 is the wrap that mirrors every second copy.
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

// By at most so many rounds of loops, which copies of the map share, and some for each copy.
ListSum sumOfList(Region r, TexelList list, ListBin bin, float rounds, inout bool finished) {
//? if roughness_bin
  ListSum sum = ListSum(0.0);
//? else
  ListSum sum = ListSum(0.0, vec2(0.0), vec2(0.0));
//? end
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
