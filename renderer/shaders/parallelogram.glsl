// The area of a box that a parallelogram (a pixel on a map) covers, by Green's theorem. With k = 1 within the columns
// of the box and K(y) = y clamped to its rows,
//   integral over P of k(x) K'(y) dx dy = - (integral around P of k(x) K(y) dx), counter-clockwise.
// This is a sum over four edges and needs no clipping. A constant may be added to K, because the integral of k(x) dx
// around P is 0.

// The mean over [a, b] of K(y) = y clamped to -1/2 and 1/2: the lengths below, within and above the box, weighted by
// the means of K over them. The antiderivative form is 0 / 0 for horizontal edges.
float meanClamped(float a, float b) {
  float low = min(a, b);
  float high = max(a, b);
  float whole = high - low;
  if (whole < 1e-6) return clamp(0.5 * (low + high), -0.5, 0.5);
  float below = clamp(-0.5 - low, 0.0, whole);
  float above = clamp(high - 0.5, 0.0, whole);
  float middle = 0.5 * (clamp(low, -0.5, 0.5) + clamp(high, -0.5, 0.5));
  return (0.5 * (above - below) + middle * (whole - below - above)) / whole;
}

// The integral of k(x) K(y) dx along the segment from `from` by `along`.
float clampedAlong(vec2 from, vec2 along) {
  float run = abs(along.x) > 1e-9 ? along.x : 1e-9;
  vec2 t = clamp((vec2(-0.5, 0.5) - from.x) / run, 0.0, 1.0);  // where it enters and leaves the box's columns
  vec2 y = from.y + along.y * t;
  return along.x * abs(t.y - t.x) * meanClamped(y.x, y.y);
}

// The covered area of the unit box about 0 for the parallelogram about `centre` with the columns of `edges`. Rounding
// error about 1e-7 of the edge lengths.
float coveredArea(vec2 centre, mat2 edges) {
  vec2 corner = centre - 0.5 * (edges[0] + edges[1]);
  float around = clampedAlong(corner, edges[0]) + clampedAlong(corner + edges[0], edges[1]) -
                 clampedAlong(corner + edges[1], edges[0]) - clampedAlong(corner, edges[1]);
  return max(determinant(edges) > 0.0 ? -around : around, 0.0);
}

// Widens a parallelogram to at least `narrowest` by moving the shorter edge away from the longer one.
mat2 widened(mat2 edges, float narrowest) {
  bool first = dot(edges[0], edges[0]) >= dot(edges[1], edges[1]);
  vec2 longer = first ? edges[0] : edges[1];
  vec2 shorter = first ? edges[1] : edges[0];
  float size = length(longer);
  if (size < narrowest) return mat2(narrowest, 0.0, 0.0, narrowest);
  vec2 along = longer / size;
  vec2 across = vec2(-along.y, along.x);
  float width = dot(shorter, across);
  float missing = max(narrowest - abs(width), 0.0);
  return mat2(longer, shorter + across * (width < 0.0 ? -missing : missing));
}
