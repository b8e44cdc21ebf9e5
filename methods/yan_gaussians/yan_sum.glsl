// Evaluates the position-normal distribution under a Gaussian footprint (Yan 2016): a sum over the elements that reach
// both the footprint and the half vector. A walk of the hierarchy finds them. Lengths are in texels.

const float seed_variance = 0.18033688;  // 1 / (8 ln 2), of an element's position along each axis

// Symmetric matrices are (xx, xy, yy).
struct Effective {
  vec3 mean_normal;  // not renormalised
  vec2 centre;
  vec2 size;         // of the map
  vec3 inverse_sum;  // of the covariance of footprint and seed together
  vec3 within;       // covariance of positions in an element, given the footprint
  vec2 reach;        // half of the rectangle of contributing elements
  float scale;       // from exp(...) to the weight of an element
  vec3 root;         // of the covariance of footprint and seed together: its lower triangular square root
  bool wide;         // wider than half of the map: copies of elements contribute
};

vec3 inverseOf(vec3 m) { return vec3(m.z, -m.y, m.x) / (m.x * m.z - m.y * m.y); }

float quadratic(vec3 m, vec2 d) { return m.x * d.x * d.x + 2.0 * m.y * d.x * d.y + m.z * d.y * d.y; }

// The sum of the weights of all elements of covariance `m` on a grid, at p from the centre of a texel, within 1e-6:
// Poisson's sum over the grid. Without this factor the texels of a magnified flat map would be visible, by a tenth.
float gridSum(vec3 m, vec2 p) {
  float row = exp(-2.0 * pi * pi * m.x) * cos(2.0 * pi * p.x);
  float column = exp(-2.0 * pi * pi * m.z) * cos(2.0 * pi * p.y);
  float rising = exp(-2.0 * pi * pi * (m.x + 2.0 * m.y + m.z)) * cos(2.0 * pi * (p.x + p.y));
  float falling = exp(-2.0 * pi * pi * (m.x - 2.0 * m.y + m.z)) * cos(2.0 * pi * (p.x - p.y));
  return 1.0 + 2.0 * (row + column + rising + falling);
}

// The Gaussian with the mean and the covariance of the pixel's parallelogram, e e^T / 12 for each edge e. Its deviation
// is limited to half of the map, which repeats: there the sum over copies is constant within 1.5%.
vec3 footprintCovariance(vec2 dx, vec2 dy, vec2 size) {
  vec3 m = vec3(dx.x * dx.x + dy.x * dy.x, dx.x * dx.y + dy.x * dy.y, dx.y * dx.y + dy.y * dy.y) / 12.0;
  vec2 narrower = min(0.5 * size * inversesqrt(max(m.xz, 1e-12)), 1.0);
  return m * vec3(narrower.x * narrower.x, narrower.x * narrower.y, narrower.y * narrower.y);
}

Effective effective(Footprints f) {
  Effective e;
  f.normal = folded(f.normal);
  e.mean_normal = fetch(mean_normal, f.normal).xyz;
  e.size = vec2(textureSize(mean_normal, 0));
  e.centre = f.normal.uv * e.size;
  e.centre -= e.size * floor(e.centre / e.size);
  vec3 pixel = footprintCovariance(f.normal.dx * e.size, f.normal.dy * e.size, e.size);
  vec3 sum = pixel + vec3(seed_variance, 0.0, seed_variance);
  e.inverse_sum = inverseOf(sum);
  // (pixel^-1 + seed^-1)^-1 = seed (1 - seed sum^-1), as seed sum^-1 pixel without a difference of large numbers.
  vec3 i = e.inverse_sum;
  e.within = seed_variance * vec3(i.x * pixel.x + i.y * pixel.y, i.x * pixel.y + i.y * pixel.z,
                                  i.y * pixel.y + i.z * pixel.z);
  e.root = vec3(sqrt(sum.x), sum.y * inversesqrt(sum.x), sqrt(sum.z - sum.y * sum.y / sum.x));
  e.reach = option_cutoff * sqrt(sum.xz);
  e.scale = 1.0 / (2.0 * pi * sqrt(sum.x * sum.z - sum.y * sum.y) * gridSum(sum, e.centre - 0.5));
  e.wide = any(greaterThan(e.reach, 0.5 * e.size));
  if (e.wide) e.within = vec3(seed_variance, 0.0, seed_variance);
  return e;
}

// The copies that contribute: those in a row, two on each side of the nearest.
float rowOfCopies(Effective e, vec2 d) {
  float sum = exp(-0.5 * quadratic(e.inverse_sum, d));
  for (int i = 1; i <= 2; ++i) {
    vec2 copy = vec2(float(i) * e.size.x, 0.0);
    sum += exp(-0.5 * quadratic(e.inverse_sum, d + copy)) + exp(-0.5 * quadratic(e.inverse_sum, d - copy));
  }
  return sum;
}

float copies(Effective e, vec2 d) {
  float sum = rowOfCopies(e, d);
  for (int i = 1; i <= 2; ++i) {
    vec2 copy = vec2(0.0, float(i) * e.size.y);
    sum += rowOfCopies(e, d + copy) + rowOfCopies(e, d - copy);
  }
  return sum;
}

uint texelAt(uint place) {
  uvec4 bytes = uvec4(texelFetch(yan_order, ivec2(place & 4095u, place >> 12u), 0) * 255.0 + 0.5);
  return bytes.x | bytes.y << 8u | bytes.z << 16u | bytes.w << 24u;
}

#if JACOBIAN_CENTRAL
// The covariance of an element's normals on the disc, by the Jacobian `slopes`: n_x by u and v, n_y by u and v.
vec3 spreadOnDisc(Effective e, vec4 slopes) {
  vec2 by_x = vec2(dot(e.within.xy, slopes.xy), dot(e.within.yz, slopes.xy));
  vec2 by_y = vec2(dot(e.within.xy, slopes.zw), dot(e.within.yz, slopes.zw));
  return vec3(dot(slopes.xy, by_x), dot(slopes.xy, by_y), dot(slopes.zw, by_y));
}

float heightOver(vec2 disc) { return sqrt(max(1.0 - dot(disc, disc), 0.0)); }

// The mean of the variances on the sphere along both axes. The change of n_z is a difference over two texels, because
// its derivative is infinite at the horizon, which two deviations reach at most: no normal is below it.
float spreadOnSphere(Effective e, vec2 disc, vec4 slopes) {
  vec3 spread = spreadOnDisc(e, slopes);
  vec2 rise = 0.5 * vec2(heightOver(disc + slopes.xz) - heightOver(disc - slopes.xz),
                         heightOver(disc + slopes.yw) - heightOver(disc - slopes.yw));
  float height = heightOver(disc);
  return min(0.5 * (spread.x + spread.z + quadratic(e.within, rise)), 0.25 * height * height);
}

#endif
// The reflectance of the element of a texel at `d` from the footprint's centre. Given the footprint, its positions have
// the mean `shift` from its own and the covariance `within`, and its normals follow by the Jacobian.
float valueOfTexel(Effective e, ivec2 at, vec2 d, Query q) {
  vec3 normal = normalize(texelFetch(mean_normal, at, 0).xyz);
  countLookups(1);
#if JACOBIAN_CENTRAL
  vec4 slopes = texelFetch(yan_jacobian, at, 0);
  countLookups(1);
  vec2 shift = e.wide ? vec2(0.0) : seed_variance * vec2(dot(e.inverse_sum.xy, d), dot(e.inverse_sum.yz, d));
#if ROUGHNESS_INTRINSIC
  vec3 spread = spreadOnDisc(e, slopes);
#else
  float spread = spreadOnSphere(e, normal.xy, slopes);
#endif
  if (slopes != vec4(0.0)) normal = onSphere(normal.xy + vec2(dot(slopes.xy, shift), dot(slopes.zw, shift)));
  return elementValue(normal, spread, q);
#else
  return elementValue(normal, no_spread, q);
#endif
}

// The contribution of an element: its weight under the footprint times the reflectance of its normals there.
float elementAt(Effective e, uint place, Query q) {
  uint texel = texelAt(place);
  uint width = uint(e.size.x);
  ivec2 at = ivec2(texel % width, texel / width);
  vec2 d = e.centre - (vec2(at) + 0.5);
  d -= e.size * round(d / e.size);
  countLookups(1);
  float weight = e.wide ? copies(e, d) : exp(-0.5 * quadratic(e.inverse_sum, d));
  float value = valueOfTexel(e, at, d, q);
  return weight > 0.0 ? weight * value : 0.0;
}

// Whether elements of a node may contribute: within `reach` of the footprint's centre, and `normal_reach` of h.
bool reaches(Effective e, uint node, vec3 h, float normal_reach) {
  ivec2 at = ivec2(node & 2047u, node >> 11u);
  vec4 low = texelFetch(yan_nodes, ivec3(at, 0), 0);
  vec4 high = texelFetch(yan_nodes, ivec3(at, 1), 0);
  countLookups(2);
  vec2 d = e.centre - 0.5 * (low.xy + high.xy) * e.size;
  d = abs(d - e.size * round(d / e.size)) - 0.5 * (high.xy - low.xy) * e.size;
  vec2 apart = max(low.zw - h.xy, h.xy - high.zw);
  return all(lessThanEqual(d, e.reach)) && all(lessThanEqual(apart, vec2(normal_reach)));
}

// The first place of a leaf, leaf * count / 2^depth, in 64 bits.
uint leafBegin(uint leaf, uint count, int depth) {
  uint high, low;
  umulExtended(leaf, count, high, low);
  return depth == 0 ? low : high << uint(32 - depth) | low >> uint(depth);
}

// Mesa 22.3's llvmpipe ends loops after 65535 rounds per pixel, over all lights, and an incomplete image must not pass
// unnoticed. A step of the walk takes one round, and five more if any of the eight pixels that are drawn together is in
// a leaf.
float notWhole() { return uintBitsToFloat(0x7fc00000u); }
// A single call may take all rounds. Each of several calls has an equal part of one half, and takes up to a quarter of
// the remainder of the other half.
const int own_steps = (shade_calls > 1 ? 4000 : 8000) / shade_calls;
int shared_steps = shade_calls > 1 ? 4000 : 0;
const int draws = max(8192 / shade_calls, 1);

// Whether the elements within reach of the footprint take more steps than allowed, for any normals.
bool isTooWide(Effective e, int most_steps) {
  vec2 sides = min(2.0 * e.reach, e.size);
  return normalReach() >= 2.0 && sides.x * sides.y > 4.0 * float(most_steps);
}

// An unbiased estimate: the mean over elements that are drawn in proportion to the footprint's weights.
float estimateOver(Effective e, Query q) {
  float sum = 0.0;
  int seen = 0;
  for (int i = 0; i < draws; ++i) {
    ++seen;
    // Multiples of powers of 1 / g with g^3 = g + 1 fill the square evenly (Roberts 2018).
    vec2 u = fract(vec2(0.5) + float(i + 1) * vec2(0.7548776662, 0.5698402910));
    float angle = 2.0 * pi * u.y;
    vec2 normal = sqrt(-2.0 * log(max(u.x, 1e-7))) * vec2(cos(angle), sin(angle));
    vec2 place = floor(e.centre + vec2(e.root.x * normal.x, e.root.y * normal.x + e.root.z * normal.y));
    sum += valueOfTexel(e, ivec2(place - e.size * floor(place / e.size)), e.centre - (place + 0.5), q);
  }
  return seen == draws ? sum / float(draws) : notWhole();
}

// Visits nodes in preorder. A node that reaches is followed by its children; otherwise, or after a leaf, by the next
// right sibling of the node or of an ancestor. The walk ends at the root, 1.
float sumOver(Effective e, Query q) {
  int depth = int(yan_depth);
  uint leaves = 1u << uint(depth);
  uint count = uint(e.size.x) * uint(e.size.y);
  float normal_reach = normalReach();
  float sum = 0.0;
  uint node = 1u;
  bool done = false;
  int most_steps = own_steps + shared_steps / 4;
  int steps = isTooWide(e, most_steps) ? most_steps : 0;
  bool walks = steps == 0;
  while (!done && steps < most_steps) {
    ++steps;
    bool inside = reaches(e, node, q.h, normal_reach);
    if (inside && node < leaves) {
      node *= 2u;
      continue;
    }
    if (inside) {
      uint place = leafBegin(node - leaves, count, depth);
      uint end = leafBegin(node - leaves + 1u, count, depth);
      float part = 0.0;
      for (; place < end; place += 2u) {
        part += elementAt(e, place, q);
        if (place + 1u < end) part += elementAt(e, place + 1u, q);
      }
      if (place < end) return notWhole();
      sum += part;
    }
    node += 1u;
    node >>= uint(findLSB(node));
    done = node == 1u;
  }
  if (walks) shared_steps -= max(steps - own_steps, 0);
  if (done) return sum * e.scale;
  return steps < most_steps ? notWhole() : estimateOver(e, q);
}

float ndf(Effective e, vec3 h) { return sumOver(e, Query(false, h, h, h)); }

float reflectedDensity(Effective e, vec3 h, vec3 wi, vec3 wo) { return sumOver(e, Query(true, h, wi, wo)); }

vec3 meanNormal(Effective e) { return e.mean_normal; }
