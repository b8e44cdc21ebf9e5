// The kernel of the pixel itself: the texels under its parallelogram, each weighted by its share.
//
// A place (x, y) has the weight k(x) k(y) in the texel with centre 0. k is the tent of bilinear filtering or, for areas, 1
// inside the texel. The integral over the parallelogram P is a sum over its edges, by Green's theorem, with K an
// antiderivative of k:
//
//   integral over P of k(x) k(y) dx dy = - (integral around P of k(x) K(y) dx),   counterclockwise.
//
// Therefore no polygon has to be clipped. Any constant may be added to K, because the integral of k(x) dx around P is 0.

#include "parallelogram.glsl"

#if KERNEL_AREAS
const float weight_reach = 0.5;  // of k to either side

float texelShare(vec2 centre, mat2 edges) { return coveredArea(centre, edges); }
#else
const float weight_reach = 1.0;  // of k to either side

// k(x) K(y) of tents: linear times quadratic on each side of 0.
float tentProduct(vec2 p) {
  float k = max(1.0 - abs(p.x), 0.0);
  float rest = max(1.0 - abs(p.y), 0.0);
  return k * sign(p.y) * 0.5 * (1.0 - rest * rest);
}

// The integral of tentProduct over t from a to b. It is cubic there, so Gauss's two points are exact.
float gaussPiece(vec2 from, vec2 along, float a, float b) {
  if (b <= a) return 0.0;
  float middle = 0.5 * (a + b);
  float off = 0.28867513 * (b - a);
  return 0.5 * (b - a) * (tentProduct(from + along * (middle - off)) + tentProduct(from + along * (middle + off)));
}

// The integral of tentProduct over the part of [a, b] on one side of x = 0, split at y = -1, 0 and 1. K is constant
// beyond.
float cutInHeight(vec2 from, vec2 along, vec3 heights, float a, float b) {
  float low = clamp(heights.x, a, b);
  float middle = clamp(heights.y, a, b);
  float high = clamp(heights.z, a, b);
  return gaussPiece(from, along, a, low) + gaussPiece(from, along, low, middle) +
         gaussPiece(from, along, middle, high) + gaussPiece(from, along, high, b);
}

// The integral of k(x) K(y) dx along the segment from `from` to `from` + `along`.
float alongEdge(vec2 from, vec2 along) {
  float run = abs(along.x) > 1e-9 ? along.x : 1e-9;
  float rise = abs(along.y) > 1e-9 ? along.y : 1e-9;
  vec3 columns = clamp((vec3(-1.0, 0.0, 1.0) - from.x) / run, 0.0, 1.0);
  vec3 heights = (vec3(-1.0, 0.0, 1.0) - from.y) / rise;
  if (run < 0.0) columns = columns.zyx;
  if (rise < 0.0) heights = heights.zyx;
  return along.x * (cutInHeight(from, along, heights, columns.x, columns.y) +
                    cutInHeight(from, along, heights, columns.y, columns.z));
}

// The weight of the texel at 0, of side 1, in a parallelogram about `centre` with `edges` as columns. The weights of all
// texels sum to its area, within a rounding error of about 1e-7 of its edge lengths.
float texelShare(vec2 centre, mat2 edges) {
  vec2 corner = centre - 0.5 * (edges[0] + edges[1]);
  float around = alongEdge(corner, edges[0]) + alongEdge(corner + edges[0], edges[1]) -
                 alongEdge(corner + edges[1], edges[0]) - alongEdge(corner, edges[1]);
  return max(determinant(edges) > 0.0 ? -around : around, 0.0);
}
#endif

// Narrower parallelograms are widened to this, because rounding would dominate their weights. Bilinear weights change by
// less than half of it over its width.
const float narrowest_pixel = 1.0 / 256.0;

// A pixel over cells of places.
struct Pixel {
  float edge;   // of a cell, in places; above 1 if one place represents all of a cell
  vec2 centre;  // in cells
  mat2 edges;   // columns, in cells
};

// Chooses the cell size that gives at most `most` cells. With area A and edge lengths B in places there are
// A / edge^2 + 4 B / edge cells, because cells that the border cuts are expensive.
Pixel pixelOn(Footprint f, vec2 size, float most) {
  mat2 edges = mat2(f.dx * size, f.dy * size);
  float area = abs(determinant(edges));
  float border = 4.0 * (length(edges[0]) + length(edges[1]));
  float edge = 0.5 * (border + sqrt(border * border + 4.0 * area * most)) / most;
  edge = max(ceil(edge - 1e-3), 1.0);
  return Pixel(edge, f.uv * size / edge, widened(edges * (1.0 / edge), narrowest_pixel));
}

// The least and the largest x of the part of an edge between two heights; least above largest if there is none.
vec2 edgeWithin(vec2 from, vec2 along, vec2 heights) {
  float rise = abs(along.y) > 1e-9 ? along.y : 1e-9;
  vec2 t = (heights - from.y) / rise;
  vec2 part = vec2(max(min(t.x, t.y), 0.0), min(max(t.x, t.y), 1.0));
  if (part.x > part.y) return vec2(1e9, -1e9);
  vec2 x = from.x + along.x * part;
  return vec2(min(x.x, x.y), max(x.x, x.y));
}

// The least and the largest x of the part of the parallelogram about 0 between two heights.
vec2 stretchWithin(mat2 edges, vec2 heights) {
  vec2 corner = -0.5 * (edges[0] + edges[1]);
  vec2 a = edgeWithin(corner, edges[0], heights);
  vec2 b = edgeWithin(corner, edges[1], heights);
  vec2 c = edgeWithin(corner + edges[1], edges[0], heights);
  vec2 d = edgeWithin(corner + edges[0], edges[1], heights);
  return vec2(min(min(a.x, b.x), min(c.x, d.x)), max(max(a.y, b.y), max(c.y, d.y)));
}

// The interval of x in which a linear function is between -1/2 and 1/2.
vec2 slab(float slope, float offset) {
  float safe = abs(slope) > 1e-9 ? slope : 1e-9;
  vec2 x = (vec2(-0.5, 0.5) - offset) / safe;
  return vec2(min(x.x, x.y), max(x.x, x.y));
}

// The interval of x in which the line at one height is inside the parallelogram about 0.
vec2 chordAt(mat2 to_pixel, float height) {
  vec2 offset = to_pixel[1] * height;
  vec2 a = slab(to_pixel[0].x, offset.x);
  vec2 b = slab(to_pixel[0].y, offset.y);
  return vec2(max(a.x, b.x), min(a.y, b.y));
}

// The first and the last cell with a centre in an interval about the pixel's centre.
ivec2 cellsIn(vec2 stretch, float centre) {
  stretch = clamp(stretch, -1e6, 1e6) + centre - 0.5;
  return ivec2(int(ceil(stretch.x)), int(floor(stretch.y)));
}

void addCell(inout Sum sum, Effective e, Pixel p, int x, int y, float share, Query q) {
  addPlace(sum, e, placeIn(ivec2(x, y), p.edge), share, q);
}

// Adds the cells of a row; false if the driver ended a loop early.
bool addRow(inout Sum sum, Effective e, Pixel p, mat2 to_pixel, int y, Query q) {
  float height = float(y) + 0.5 - p.centre.y;
  vec2 reach = vec2(-weight_reach, weight_reach);
  ivec2 all = cellsIn(stretchWithin(p.edges, height + reach) + reach, p.centre.x);
  vec2 lower = chordAt(to_pixel, height - weight_reach);
  vec2 upper = chordAt(to_pixel, height + weight_reach);
  ivec2 whole = cellsIn(vec2(max(lower.x, upper.x), min(lower.y, upper.y)) - reach, p.centre.x);
  if (whole.x > whole.y) whole = ivec2(all.y + 1, all.y);
  int seen = 0;  // the compiler would assume the final value of the loop's own counter
  for (int x = whole.x; x <= whole.y; x += 4) {
    seen += 4;
    Sum four = zeroSum();
    addCell(four, e, p, x, y, 1.0, q);
    addCell(four, e, p, x + 1, y, x + 1 <= whole.y ? 1.0 : 0.0, q);
    addCell(four, e, p, x + 2, y, x + 2 <= whole.y ? 1.0 : 0.0, q);
    addCell(four, e, p, x + 3, y, x + 3 <= whole.y ? 1.0 : 0.0, q);
    addSum(sum, four, 1.0);
  }
  // The cells on each side that the border cuts: their shares cost more than their facets.
  int inside = max(min(whole.y, all.y) - max(whole.x, all.x) + 1, 0);
  int border = all.y - all.x + 1 - inside;
  int seen_border = 0;
  for (int i = 0; i < border; ++i) {
    ++seen_border;
    int cut = all.x + i;
    if (cut >= whole.x) cut += inside;
    addCell(sum, e, p, cut, y, texelShare(p.centre - vec2(cut, y) - 0.5, p.edges), q);
  }
  return seen > whole.y - whole.x && seen_border >= border;
}

Sum sumOver(Effective e, Query q) {
  Pixel p = pixelOn(e.footprint, e.size, mostTexels(q));
  mat2 to_pixel = inverse(p.edges);
  float half_height = 0.5 * (abs(p.edges[0].y) + abs(p.edges[1].y)) + weight_reach;
  ivec2 rows = cellsIn(vec2(-half_height, half_height), p.centre.y);
  Sum sum = zeroSum();
  bool done = true;
  int seen = 0;
  for (int y = rows.x; y <= rows.y; ++y) {
    ++seen;
    Sum row = zeroSum();
    done = addRow(row, e, p, to_pixel, y, q) && done;
    addSum(sum, row, 1.0);
  }
  if (seen <= rows.y - rows.x || !done) return notWhole();
  return meanOf(sum, e, q);
}
