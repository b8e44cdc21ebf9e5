// The kernel of the pixel itself: the texels under its parallelogram, each by its share.
//? include exact_weights.glsl

// A pixel over cells of places.
struct Pixel {
  float edge;   // of a cell, in places; above 1 where one place stands for all of a cell
  vec2 centre;  // in cells
  mat2 edges;   // columns, in cells
};

// As many cells as area and circumference call for, at most `most`: with area A and lengths of
// both edges B in places, A / edge^2 + 4 B / edge of them; those that the border cuts are dear.
Pixel pixelOn(Footprint f, vec2 size, float most) {
  mat2 edges = mat2(f.dx * size, f.dy * size);
  float area = abs(determinant(edges));
  float border = 4.0 * (length(edges[0]) + length(edges[1]));
  float edge = 0.5 * (border + sqrt(border * border + 4.0 * area * most)) / most;
  edge = max(ceil(edge - 1e-3), 1.0);
  return Pixel(edge, f.uv * size / edge, widened(edges * (1.0 / edge), narrowest_pixel));
}

// What of an edge lies between two heights: least and largest x; the one above the other where it has nothing there.
vec2 edgeWithin(vec2 from, vec2 along, vec2 heights) {
  float rise = abs(along.y) > 1e-9 ? along.y : 1e-9;
  vec2 t = (heights - from.y) / rise;
  vec2 part = vec2(max(min(t.x, t.y), 0.0), min(max(t.x, t.y), 1.0));
  if (part.x > part.y) return vec2(1e9, -1e9);
  vec2 x = from.x + along.x * part;
  return vec2(min(x.x, x.y), max(x.x, x.y));
}

// What of the parallelogram about 0 lies between two heights: least and largest x.
vec2 stretchWithin(mat2 edges, vec2 heights) {
  vec2 corner = -0.5 * (edges[0] + edges[1]);
  vec2 a = edgeWithin(corner, edges[0], heights);
  vec2 b = edgeWithin(corner, edges[1], heights);
  vec2 c = edgeWithin(corner + edges[1], edges[0], heights);
  vec2 d = edgeWithin(corner + edges[0], edges[1], heights);
  return vec2(min(min(a.x, b.x), min(c.x, d.x)), max(max(a.y, b.y), max(c.y, d.y)));
}

// Between which x a linear function of it is between -1/2 and 1/2.
vec2 slab(float slope, float offset) {
  float safe = abs(slope) > 1e-9 ? slope : 1e-9;
  vec2 x = (vec2(-0.5, 0.5) - offset) / safe;
  return vec2(min(x.x, x.y), max(x.x, x.y));
}

// The part of a line of one height inside of the parallelogram about 0.
vec2 chordAt(mat2 to_pixel, float height) {
  vec2 offset = to_pixel[1] * height;
  vec2 a = slab(to_pixel[0].x, offset.x);
  vec2 b = slab(to_pixel[0].y, offset.y);
  return vec2(max(a.x, b.x), min(a.y, b.y));
}

// Cells whose centres lie in a stretch about the pixel's centre: first and last.
ivec2 cellsIn(vec2 stretch, float centre) {
  stretch = clamp(stretch, -1e6, 1e6) + centre - 0.5;
  return ivec2(int(ceil(stretch.x)), int(floor(stretch.y)));
}

void addCell(inout Sum sum, Effective e, Pixel p, int x, int y, float share, Query q) {
  addPlace(sum, e, placeIn(ivec2(x, y), p.edge), share, q);
}

// Adds the cells of a row; false where a loop was ended before it was done.
bool addRow(inout Sum sum, Effective e, Pixel p, mat2 to_pixel, int y, Query q) {
  float height = float(y) + 0.5 - p.centre.y;
  vec2 reach = vec2(-weight_reach, weight_reach);
  ivec2 all = cellsIn(stretchWithin(p.edges, height + reach) + reach, p.centre.x);
  vec2 lower = chordAt(to_pixel, height - weight_reach);
  vec2 upper = chordAt(to_pixel, height + weight_reach);
  ivec2 whole = cellsIn(vec2(max(lower.x, upper.x), min(lower.y, upper.y)) - reach, p.centre.x);
  if (whole.x > whole.y) whole = ivec2(all.y + 1, all.y);
  int seen = 0;  // of a loop's own counter the compiler knows what it is behind the loop
  for (int x = whole.x; x <= whole.y; x += 4) {
    seen += 4;
    Sum four = zeroSum();
    addCell(four, e, p, x, y, 1.0, q);
    addCell(four, e, p, x + 1, y, x + 1 <= whole.y ? 1.0 : 0.0, q);
    addCell(four, e, p, x + 2, y, x + 2 <= whole.y ? 1.0 : 0.0, q);
    addCell(four, e, p, x + 3, y, x + 3 <= whole.y ? 1.0 : 0.0, q);
    addSum(sum, four, 1.0);
  }
  // Cells that the border cuts, to either side of those: their shares cost more than their facets.
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
