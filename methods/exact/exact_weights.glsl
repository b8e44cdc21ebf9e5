// How much of a pixel's parallelogram a texel has. A place (x, y) weighs k(x) k(y) in the texel whose centre is 0, k
// being the tent of bilinear filtering or, for areas, 1 inside of the texel. Over the parallelogram P that is a sum over
// its edges, by Green's theorem: with K an antiderivative of k,
//
//   integral over P of k(x) k(y) dx dy = - (integral around P of k(x) K(y) dx),   counterclockwise,
//
// and no polygon has to be cut. Any constant may be added to K: around P the integral of k(x) dx is 0.

//? include parallelogram.glsl

//? if kernel_areas
const float weight_reach = 0.5;  // of k to either side

float texelShare(vec2 centre, mat2 edges) { return coveredArea(centre, edges); }
//? else
const float weight_reach = 1.0;  // of k to either side

// k(x) K(y) of tents: linear times quadratic on either side of 0.
float tentProduct(vec2 p) {
  float k = max(1.0 - abs(p.x), 0.0);
  float rest = max(1.0 - abs(p.y), 0.0);
  return k * sign(p.y) * 0.5 * (1.0 - rest * rest);
}

// Its integral over t from a to b: cubic there, so Gauss's two points are exact.
float gaussPiece(vec2 from, vec2 along, float a, float b) {
  if (b <= a) return 0.0;
  float middle = 0.5 * (a + b);
  float off = 0.28867513 * (b - a);
  return 0.5 * (b - a) * (tentProduct(from + along * (middle - off)) + tentProduct(from + along * (middle + off)));
}

// Over the part of [a, b] on one side of x = 0: cut where y is -1, 0 and 1, beyond which K is constant.
float cutInHeight(vec2 from, vec2 along, vec3 heights, float a, float b) {
  float low = clamp(heights.x, a, b);
  float middle = clamp(heights.y, a, b);
  float high = clamp(heights.z, a, b);
  return gaussPiece(from, along, a, low) + gaussPiece(from, along, low, middle) +
         gaussPiece(from, along, middle, high) + gaussPiece(from, along, high, b);
}

// The integral of k(x) K(y) dx along the straight way from `from` by `along`.
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

// The weight of the texel at 0, of side 1, in a parallelogram about `centre` with `edges` for columns. Those of all
// texels sum to its area, but for rounding: some 1e-7 of its edges' lengths.
float texelShare(vec2 centre, mat2 edges) {
  vec2 corner = centre - 0.5 * (edges[0] + edges[1]);
  float around = alongEdge(corner, edges[0]) + alongEdge(corner + edges[0], edges[1]) -
                 alongEdge(corner + edges[1], edges[0]) - alongEdge(corner, edges[1]);
  return max(determinant(edges) > 0.0 ? -around : around, 0.0);
}
//? end

// No parallelogram is narrower than this: of one that is, rounding would leave little. Bilinear weights change by less
// than half of it over its width.
const float narrowest_pixel = 1.0 / 256.0;
