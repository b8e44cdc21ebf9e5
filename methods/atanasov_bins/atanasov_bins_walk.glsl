// The area of a list's texels under a footprint. A footprint that reaches over the map's border is taken apart: each
// copy of the map that it touches is walked with the footprint moved, and mirrored, to where the map is.
//? include atanasov_bins_lists.glsl
//? include atanasov_bins_region.glsl

// Halving 2^28 texels down to 16, an odd side's longer part each time, takes 26 steps.
const int most_pending = 28;
const uint leaf_size = 16u;

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

// Makes a node its lower half; the upper half comes back.
Node upperHalfOf(inout Node node) {
  ivec2 sides = node.upper - node.lower;
  ivec2 middle = sides.x >= sides.y ? ivec2(node.lower.x + sides.x / 2, 0) : ivec2(0, node.lower.y + sides.y / 2);
  Node half_node = Node(wordAt(bins_forest, node.at + 1u), node.end, max(node.lower, middle), node.upper);
  node.end = wordAt(bins_forest, node.at);
  node.at += 2u;
  node.upper = sides.x >= sides.y ? ivec2(middle.x, node.upper.y) : ivec2(node.upper.x, middle.y);
  return half_node;
}

// What a list has under a region.
struct Covered {
  uint whole;    // texels that are covered whole
  float partly;  // the area of those that are not
};

// Texel i of a list.
void addTexel(inout Covered sum, Region r, vec4 beyond, uint i) {
  ivec2 texel = unpacked(wordAt(bins_texels, i));
  vec4 box = boxOf(texel, texel + 1, beyond);
  int side = sideOf(r, box.xy, box.zw);
  if (side == inside) ++sum.whole;
  if (side == cut) sum.partly += areaWithin(r, box.xy, box.zw);
}

//? if border_nodes
// Sides below which a node that the border cuts counts by the share of it that is covered, as if its texels were spread
// evenly: a quarter of the side of a square as large as the footprint; half of it where many lists are summed.
//? if roughness_bin
float evenSide(Region r) { return 0.25 * sqrt(areaOf(r)); }
//? else
float evenSide(Region r) { return 0.5 * sqrt(areaOf(r)); }
//? end

void addNode(inout Covered sum, Region r, vec4 box, uint texels) {
  vec2 sides = box.zw - box.xy;
  sum.partly += float(texels) * areaWithin(r, box.xy, box.zw) / (sides.x * sides.y);
}
//? end

// Over one copy of the map. One loop looks at nodes and at the texels of leaves alike: pixels that are drawn together
// wait for each other at the end of every loop. `finished` becomes false where the driver has ended it before its end
// (notWhole).
float areaInCopy(Region r, TexelList list, inout bool finished) {
  vec4 beyond = beyondMap(r);
//? if border_nodes
  float even_side = evenSide(r);
//? end
  Node node = Node(list.root, list.end, ivec2(0), textureSize(bins_map, 0));
  uvec4 pending[most_pending];
  int count = 0;
  uint begin = list.first;
  bool in_leaf = false;
  Covered sum = Covered(0u, 0.0);
  while (begin < list.end) {
    if (in_leaf) {
      addTexel(sum, r, beyond, begin);
      ++begin;
    } else {
      vec4 box = boxOf(node.lower, node.upper, beyond);
      int side = sideOf(r, box.xy, box.zw);
//? if border_nodes
      if (side == cut && all(lessThan(box.zw - box.xy, vec2(even_side)))) {
        addNode(sum, r, box, node.end - begin);
        side = outside;
      }
//? end
      in_leaf = side == cut && node.end - begin <= leaf_size;
      if (side == cut && !in_leaf) {
        Node later = upperHalfOf(node);
        pending[count] = uvec4(later.at, later.end, later.lower.x | later.lower.y << 16,
                               later.upper.x | later.upper.y << 16);
        ++count;
      } else if (!in_leaf) {
        if (side == inside) sum.whole += node.end - begin;
        begin = node.end;
      }
    }
    if (begin == node.end && count > 0) {
      --count;
      uvec4 next = pending[count];
      node = Node(next.x, next.y, unpacked(next.z), unpacked(next.w));
      in_leaf = false;
    }
  }
  finished = finished && begin == list.end;
  return float(sum.whole) + sum.partly;
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
