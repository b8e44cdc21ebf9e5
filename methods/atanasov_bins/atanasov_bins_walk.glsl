// The area of a list's texels under a footprint. A footprint that reaches over the map's border is taken apart: each
// copy of the map that it touches is walked with the footprint moved, and mirrored, to where the map is.
//? include atanasov_bins_lists.glsl
//? include atanasov_bins_region.glsl

// Halving 2^28 texels down to 16, an odd side's longer part each time, takes 26 steps.
const int most_pending = 28;
const int most_cut = 16;  // that are put aside before their areas are taken
const uint leaf_size = 16u;
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

//? if border_nodes
// Sides below which a node that the border cuts counts by the share of it that is covered, as if its texels were spread
// evenly: a quarter of the side of a square as large as the footprint; half of it where many lists are summed.
//? if roughness_bin
float evenSide(Region r) { return 0.25 * sqrt(areaOf(r)); }
//? else
float evenSide(Region r) { return 0.5 * sqrt(areaOf(r)); }
//? end
//? else
float evenSide(Region r) { return 0.0; }
//? end

// Over one copy of the map. One loop looks at nodes and at the texels of leaves alike: pixels that are drawn together
// wait for each other at the end of every loop, and llvmpipe takes every branch. So what the border cuts, a few of
// many, is put aside for a loop of its own. `finished` becomes false where the driver has ended one before its end
// (notWhole).
float areaInCopy(Region r, TexelList list, inout bool finished) {
  vec4 beyond = beyondMap(r);
  float even_side = evenSide(r);
  Node node = Node(list.root, list.end, ivec2(0), textureSize(bins_map, 0));
  uvec4 kept[most_pending + most_cut];  // nodes that are left to be looked at, then what is cut
  int pending = 0;
  int cut_count = 0;
  uint begin = list.first;
  bool in_leaf = false;
  uint whole = 0u;     // texels that are covered whole
  float partly = 0.0;  // the area of the others
  while (begin < list.end) {
    while (begin < list.end && cut_count < most_cut) {
      Node seen = node;
      if (in_leaf) seen = texelNode(begin);
      uint texels = seen.end - begin;
      vec4 box = boxOf(seen.lower, seen.upper, beyond);
      vec2 sides = box.zw - box.xy;
      // Texels that go on beyond the map are larger than others: none stands for another.
      bool goes_on = any(greaterThan(sides, vec2(seen.upper - seen.lower)));
      int side = sideOf(r, box.xy, box.zw);
      if (goes_on && side == inside) side = cut;
      bool counts = side == cut && (in_leaf || !goes_on && all(lessThan(sides, vec2(even_side))));
      bool splits = side == cut && !counts && texels > leaf_size;
      int slot = counts ? most_pending + cut_count : pending;
      if (splits) {
        seen = upperHalfOf(node, begin);
        ++pending;
      } else if (counts) {
        seen.end = texels;
        ++cut_count;
      }
      if (splits || counts) kept[slot] = packedNode(seen);
      if (side == inside) whole += texels;
      in_leaf = in_leaf || side == cut && !counts && !splits;
      if (side != cut || counts) begin += texels;
      if (begin == node.end && pending > 0) {
        --pending;
        node = unpackedNode(kept[pending]);
        in_leaf = false;
      }
    }
    for (; cut_count > 0; --cut_count) {
      Node seen = unpackedNode(kept[most_pending + cut_count - 1]);
      vec4 box = boxOf(seen.lower, seen.upper, beyond);
      vec2 sides = vec2(seen.upper - seen.lower);
      partly += float(seen.end) / (sides.x * sides.y) * areaWithin(r, box.xy, box.zw);
    }
  }
  finished = finished && begin == list.end && cut_count == 0;
  return float(whole) + partly;
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

float areaOfList(Region r, TexelList list, inout bool finished) {
  vec2 size = mapSize();
  ivec2 columns = copiesAlong(r.centre.x, r.reach.x, size.x, bins_wrap_u);
  ivec2 rows = copiesAlong(r.centre.y, r.reach.y, size.y, bins_wrap_v);
  int across = max(columns.y - columns.x + 1, 1);
  int copies = across * max(rows.y - rows.x + 1, 1);
  float area = 0.0;
  int seen = 0;
  for (int i = 0; i < copies; ++i) {
    ++seen;
    ivec2 copy = ivec2(columns.x + i % across, rows.x + i / across);
    area += areaInCopy(inCopy(r, copy), list, finished);
  }
  finished = finished && seen >= copies;
  return area;
}
