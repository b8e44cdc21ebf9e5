// Area weights: each texel of one level counts with its share of the footprint (docs/reference/filters.md). One
// bilinear lookup reads 2 x 2 texels, with their total weight, at the position that sets their shares. The footprint P
// is convolved with the tent of bilinear filtering at the finest level; a texel of level l has the integral of P
// convolved with a box of 2^-l of its width. For strips of two rows the weight factors into the share of a row, from
// the extent of P across rows, and that of a column, from the section of P at half height. Boxes of widths u and v that
// are small against a third are one of width sqrt(u^2 + v^2). Shares are differences of a distribution function and sum
// to one; the outermost include the remainder.

// The position of a point along an axis: two boxes convolved about 0.
struct Boxes {
  float reach;    // to either side
  float plateau;  // to where the density is even
  float density;  // there
  float tail;     // share of the rest up to the end, squared
};

// The narrowest box; rounding would affect narrower ones. Bilinear weights change by less than half of it over its
// width.
const float narrowest_box = 1.0 / 1024.0;

Boxes boxesOf(float a, float b) {
  float u = max(a, narrowest_box);
  float v = max(b, narrowest_box);
  return Boxes(0.5 * (u + v), 0.5 * abs(u - v), 1.0 / max(u, v), 0.5 / (u * v));
}

// The distribution function. Tails are squares of the remaining length, which avoids cancellation.
float boxesBelow(Boxes b, float x) {
  float t = abs(x);
  float rest = max(b.reach - t, 0.0);
  float beyond = t < b.plateau ? 0.5 - t * b.density : rest * rest * b.tail;
  return x < 0.0 ? beyond : 1.0 - beyond;
}

// A pair of texels about `middle`: their share, and the part of the second texel.
struct PairShare {
  float whole;
  float second;
};

PairShare pairShare(Boxes b, float middle, bool first, bool last) {
  float low = first ? 0.0 : boxesBelow(b, middle - 1.0);
  float high = last ? 1.0 : boxesBelow(b, middle + 1.0);
  float whole = max(high - low, 0.0);
  return PairShare(whole, whole > 1e-6 ? clamp((high - boxesBelow(b, middle)) / whole, 0.0, 1.0) : 0.5);
}

// The margin of a box at each end, in texels, that goes to the outermost texels; otherwise one more texel would have
// almost no weight. Almost 0 for a narrow box, whose texels blend as in a bilinear lookup.
const float widest_hem = 0.35;
float hemOf(float extent) { return max(widest_hem * min(0.5 * extent, 1.0), 2.0 * narrowest_box); }

// The number of pairs that cover an interval of an axis at any offset.
float pairsOf(float extent) { return ceil(0.5 * (ceil(extent) + 1.0)); }

// Lookups by strips of two rows and pairs of columns, across the axis along which the footprint is longer. Common
// values are computed once, because llvmpipe does not move code out of loops.
struct Probes {
  int count;
  float level;
  vec2 texel;   // of the level: its sides, in texture coordinates
  bool turned;  // rows run along v
  vec2 centre;  // of the footprint, (column, row), the first texel's being 0
  float strips;
  float pairs;      // of columns, in a strip
  float per_pairs;  // 1 over them
  float first_row;  // from the centre
  Boxes rows;       // the footprint's extent across rows
  float reach;      // half of it, without what the finest level's tent adds
  float lean;       // columns to a row
  float across;     // columns that the other edge crosses within a row
  float half_edge;  // of the edge that crosses more rows, half its rows
  float per_rise;   // 1 over the rows that the other edge crosses
  float smear;      // what the finest level's tent leaves, in columns
  float hem;        // of columns
};

// The edge that crosses more rows, and the other one, both upwards.
struct RowEdges {
  vec2 edge;
  vec2 other;
};

vec2 upwards(vec2 edge) { return edge.y < 0.0 ? -edge : edge; }

RowEdges rowEdges(vec2 a, vec2 b) {
  bool first = abs(a.y) >= abs(b.y);
  RowEdges e = RowEdges(upwards(first ? a : b), upwards(first ? b : a));
  e.edge.y = max(e.edge.y, narrowest_box);
  return e;
}

float leanOf(RowEdges e) { return e.edge.x / e.edge.y; }

// The widest section of a row.
float widestOf(RowEdges e) {
  return abs(e.other.x - e.other.y * leanOf(e)) * min(e.edge.y / max(e.other.y, 1e-12 * e.edge.y), 1.0);
}

// The scale s: the width of a finest texel over that of texels of which 2N x 2N cover a footprint of height h and width
// w. There are (h + 1) s - 2 hems + 1 rows, with 1 for the tent, times the columns of w, which span two rows. Uses the
// form of the root without cancellation.
float areaScale(RowEdges e) {
  const float rim = 1.0 - 2.0 * widest_hem;
  float high = e.edge.y + e.other.y + 1.0;
  float wide = widestOf(e) + 1.0;
  float slanted = rim + 2.0 * abs(leanOf(e));
  float linear = high * slanted + wide * rim;
  float missing = 4.0 * float(most_probes * most_probes) - rim * slanted;
  return 2.0 * missing / (linear + sqrt(linear * linear + 4.0 * high * wide * missing));
}

Probes probesOf(vec2 size, Footprint f) {
  const float most = 1e8;  // of a footprint that is none: edges whose squares are numbers
  vec2 edge_x = clamp(f.dx * size, -most, most);
  vec2 edge_y = clamp(f.dy * size, -most, most);
  Probes p;
  p.turned = abs(edge_x.x) + abs(edge_y.x) > abs(edge_x.y) + abs(edge_y.y);
  RowEdges e = p.turned ? rowEdges(edge_x.yx, edge_y.yx) : rowEdges(edge_x, edge_y);
  float s = areaScale(e);
  ivec2 finest = ivec2(size);
  p.level = clamp(ceil(-log2(s)), 0.0, float(findMSB(max(finest.x, finest.y))));
  vec2 texels = levelSize(finest, int(p.level));
  p.texel = 1.0 / texels;
  vec2 centre = f.uv * texels - 0.5;
  vec2 smear = texels / size;  // a finest texel's sides
  p.centre = p.turned ? centre.yx : centre;
  if (p.turned) smear = smear.yx;
  // A footprint wider than 2N texels of the coarsest level weighs them equally.
  vec2 scale = smear * min(s * exp2(p.level), 1.0);
  e.edge *= scale;
  e.other *= scale;
  p.reach = 0.5 * (e.edge.y + e.other.y);
  p.lean = leanOf(e);
  p.across = e.other.x - e.other.y * p.lean;
  p.half_edge = 0.5 * e.edge.y;
  p.per_rise = 1.0 / max(e.other.y, 1e-6 * e.edge.y);
  p.smear = smear.x;
  p.rows = boxesOf(e.edge.y, length(vec2(e.other.y, smear.y)));
  float row_hem = hemOf(2.0 * p.reach);
  p.first_row = floor(p.centre.y - p.rows.reach + row_hem + 0.5) - p.centre.y;
  p.strips = pairsOf(2.0 * (p.rows.reach - row_hem));
  float wide = widestOf(e);
  p.hem = hemOf(wide);
  p.pairs = pairsOf(wide + length(vec2(p.lean * min(2.0 * p.reach, 2.0), smear.x)) - 2.0 * p.hem);
  p.per_pairs = 1.0 / p.pairs;
  p.count = probesHere(int(p.strips * p.pairs));
  return p;
}

// A lookup: (column, row) relative to the footprint's centre, and its share of the footprint.
struct AreaLookup {
  vec2 place;
  float share;
};

AreaLookup areaLookup(Probes p, int i) {
  float strip = floor((float(i) + 0.5) * p.per_pairs);
  float row = p.first_row + 2.0 * strip;
  PairShare rows = pairShare(p.rows, row + 0.5, (strip < 0.5), (strip > p.strips - 1.5));
  float low = max(row - 0.5, -p.reach);
  float high = min(row + 1.5, p.reach);
  float halfway = clamp(0.5 * (low + high), -p.reach, p.reach);
  // The point edge u + other v of the footprint at that height: the range of v for u in [-1/2, 1/2].
  float from = max((halfway - p.half_edge) * p.per_rise, -0.5);
  float to = min((halfway + p.half_edge) * p.per_rise, 0.5);
  float middle = p.lean * halfway + p.across * 0.5 * (from + to);
  Boxes section = boxesOf(abs(p.across) * (to - from), length(vec2(p.lean * max(high - low, 0.0), p.smear)));
  float pair = float(i) - strip * p.pairs;
  float column = floor(p.centre.x + middle - section.reach + p.hem + 0.5) - p.centre.x + 2.0 * pair;
  PairShare columns = pairShare(section, column + 0.5 - middle, (pair < 0.5), (pair > p.pairs - 1.5));
  return AreaLookup(vec2(column + columns.second, row + rows.second), rows.whole * columns.whole);
}

vec2 probeUv(Footprint f, Probes p, int i) {
  vec2 at = p.centre + areaLookup(p, i).place;
  return ((p.turned ? at.yx : at) + 0.5) * p.texel;
}

float probeWeight(Probes p, int i) { return areaLookup(p, i).share; }
