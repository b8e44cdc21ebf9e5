// The kernel of the footprint filter. Each texel that the filter would blend is replaced by the mean over the box of
// finest-level texels that it covers.

// The part of [cell, cell + 1] between two bounds.
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

// Bounds are whole numbers unless a level has an odd size. The tolerance keeps rounding from adding slivers.
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

// The mean over a box of places, `lower` to `upper`, with at most `most` lookups.
Sum boxMean(Effective e, vec2 lower, vec2 upper, float most, Query q) {
  vec2 sides = upper - lower;
  float edge = max(ceil(sqrt(sides.x * sides.y / most) - 1e-3), 1.0);
  Cells cells = cellsOf(lower / edge, upper / edge);
  Sum box = zeroSum();
  int seen = 0;  // the compiler would assume the final value of the loop's own counter
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
  // Half of the eight texels are on the coarser level, where four of them cover the area of all.
  float most = 2.0 * mostTexels(q) / float(count);
  int seen = 0;
  for (int i = 0; i < count; ++i) {
    ++seen;
    FootprintTexel texel = footprintTexel(finest, e.footprint, i);
    if (texel.weight <= 0.0) continue;
    vec2 texels = levelSize(finest, int(texel.level));
    // A map that does not repeat is continued by the outermost texel of the level.
    vec2 within = clamp(texel.uv, 0.5 / texels, 1.0 - 0.5 / texels);
    vec2 uv = mix(texel.uv, within, vec2(exact_clamp_u, exact_clamp_v));
    vec2 middle = uv * e.size;
    vec2 reach = 0.5 * e.size / texels;
    addSum(sum, boxMean(e, middle - reach, middle + reach, most, q), texel.weight);
  }
  if (seen < count) return notWhole();
  return meanOf(sum, e, q);
}
