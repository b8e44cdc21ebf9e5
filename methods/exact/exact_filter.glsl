// The kernel of the footprint filter: each texel that it would blend stands for the box of the finest level's texels
// that it covers.

// The part of [cell, cell + 1] that lies between two bounds.
float shareOfCell(int cell, float lower, float upper) {
  return clamp(min(upper, float(cell) + 1.0) - max(lower, float(cell)), 0.0, 1.0);
}

// Cells of places that a box from `lower` to `upper` touches, row by row; bounds in cells.
struct Cells {
  vec2 lower;
  vec2 upper;
  ivec2 first;
  int across;
  int count;
};

// Bounds are whole but where a level has an odd size; rounding makes no slivers.
Cells cellsOf(vec2 lower, vec2 upper) {
  ivec2 first = ivec2(floor(lower + 1e-3));
  ivec2 sides = ivec2(ceil(upper - 1e-3)) - first;
  return Cells(lower, upper, first, sides.x, sides.x * sides.y);
}

void addCell(inout Sum sum, Effective e, Cells cells, int i, float edge, Query q) {
  int row = int((float(i) + 0.5) / float(cells.across));
  ivec2 cell = cells.first + ivec2(i - row * cells.across, row);
  float share = shareOfCell(cell.x, cells.lower.x, cells.upper.x) * shareOfCell(cell.y, cells.lower.y, cells.upper.y);
  addPlace(sum, e, placeIn(cell, edge), i < cells.count ? share : 0.0, q);
}

// The mean over a box of places, `lower` to `upper`, of which `most` may be looked at.
Sum boxMean(Effective e, vec2 lower, vec2 upper, float most, Query q) {
  vec2 sides = upper - lower;
  float edge = max(ceil(sqrt(sides.x * sides.y / most) - 1e-3), 1.0);
  Cells cells = cellsOf(lower / edge, upper / edge);
  Sum box = zeroSum();
  int seen = 0;  // of the loop's own counter the compiler knows what it is behind the loop
  for (int i = 0; i < cells.count; i += 4) {
    ++seen;
    Sum four = zeroSum();
    addCell(four, e, cells, i, edge, q);
    addCell(four, e, cells, i + 1, edge, q);
    addCell(four, e, cells, i + 2, edge, q);
    addCell(four, e, cells, i + 3, edge, q);
    addSum(box, four, 1.0);
  }
  if (4 * seen < cells.count) return notWhole();
  Sum mean = zeroSum();
  addSum(mean, box, edge * edge / (sides.x * sides.y));
  return mean;
}

Sum sumOver(Effective e, Query q) {
  ivec2 finest = ivec2(e.size);
  Sum sum = zeroSum();
  int count = footprintTexelCount(finest, e.footprint);
  // Of eight texels four lie on the coarser level, a square of theirs being what all of them cover.
  float most = 2.0 * mostTexels(q) / float(count);
  int seen = 0;
  for (int i = 0; i < count; ++i) {
    ++seen;
    FootprintTexel texel = footprintTexel(finest, e.footprint, i);
    if (texel.weight <= 0.0) continue;
    vec2 texels = levelSize(finest, int(texel.level));
    // Beyond the border of a map that does not repeat its outermost texel of that level goes on.
    vec2 within = clamp(texel.uv, 0.5 / texels, 1.0 - 0.5 / texels);
    vec2 uv = mix(texel.uv, within, vec2(exact_clamp_u, exact_clamp_v));
    vec2 middle = uv * e.size;
    vec2 reach = 0.5 * e.size / texels;
    addSum(sum, boxMean(e, middle - reach, middle + reach, most, q), texel.weight);
  }
  if (seen < count) return notWhole();
  return meanOf(sum, e, q);
}
