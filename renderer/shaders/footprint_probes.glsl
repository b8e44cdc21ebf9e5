// The footprint filters (docs/reference/filters.md): positions, common level and weights of the trilinear lookups for a
// footprint. The weights sum to one. There is at least one probe, so loops test at their end; a test at the head makes
// llvmpipe execute the body once more for no pixel.

#if FILTER_AREA
#include "footprint_area.glsl"
#else
struct Probes {
  int count;
  float level;
#if FILTER_ANISOTROPIC || FILTER_HARDWARE
  vec2 step;     // from probe to probe, in texture coordinates
  float weight;  // of each
#endif
#if FILTER_EWA
  vec2 axis;      // in texture coordinates: the longer one
  float falloff;  // the weight of the probe at axis t is exp(-falloff t^2) of the middle's
  float whole;    // their sum
#endif
};

// The level with texels as wide as the longer edge of one of `parts` x `parts` equal parts (OpenGL 4.5, section 8.14).
// A trilinear lookup is a tent over boxes; lookups spaced by the texel width add up to a box with a flat top.
float levelOf(vec2 size, Footprint f, float parts) {
  vec2 edge_x = f.dx * size;
  vec2 edge_y = f.dy * size;
  return 0.5 * log2(max(max(dot(edge_x, edge_x), dot(edge_y, edge_y)) / (parts * parts), 1e-24));
}

#if FILTER_ANISOTROPIC || FILTER_HARDWARE
// Equal probes along the longer edge at the level of the shorter one, as EXT_texture_filter_anisotropic has them. An
// even footprint must have one probe despite rounding: two are a whole level finer.
Probes probesOf(vec2 size, Footprint f) {
  float along_x = length(f.dx * size);
  float along_y = length(f.dy * size);
  float major = max(max(along_x, along_y), 1e-12);
  float minor = min(along_x, along_y);
  int count = probesHere(int(ceil(min(0.999 * major / max(minor, 1e-12), float(most_probes)))));
  vec2 axis = along_x > along_y ? f.dx : f.dy;
  return Probes(count, log2(major / float(count)), axis / float(count + 1), 1.0 / float(count));
}

vec2 probeUv(Footprint f, Probes p, int i) { return f.uv + p.step * (float(i) - 0.5 * float(p.count - 1)); }
float probeWeight(Probes p, int i) { return p.weight; }
#elif FILTER_BOX
// n x n equal probes at the centres of parts that tile the footprint.
Probes probesOf(vec2 size, Footprint f) {
  return Probes(probesHere(footprint_parts * footprint_parts), levelOf(size, f, float(footprint_parts)));
}

vec2 probeUv(Footprint f, Probes p, int i) {
  vec2 at = (vec2(i % footprint_parts, i / footprint_parts) + 0.5) / float(footprint_parts) - 0.5;
  return f.uv + f.dx * at.x + f.dy * at.y;
}

float probeWeight(Probes p, int i) { return 1.0 / float(p.count); }
#elif FILTER_EWA
// Position along the longer axis of the ellipse, -1 to 1.
float probeAxis(Probes p, int i) { return p.count > 1 ? 2.0 * float(i) / float(p.count - 1) - 1.0 : 0.0; }

float probeWeight(Probes p, int i) {
  float t = probeAxis(p, i);
  return exp(-p.falloff * t * t) / p.whole;
}

// Heckbert 1989: a Gaussian exp(-2 r^2) over the ellipse to which the edges map the unit circle, cut off at its border.
// Its variance along an axis of radius s is s^2 / 4, that of a trilinear lookup in texels of width t is t^2 / 4. With t
// the shorter radius, a lookup is the Gaussian across. Along the longer axis, probes at most t apart add the missing
// variance, up to s - t from the centre (as McCormack et al. 1999). If most_probes are too few, t grows.
Probes probesOf(vec2 size, Footprint f) {
  // J J^T = (a b; b c) of the edges in texels; its eigenvalues are the squared radii.
  vec2 edge_x = f.dx * size;
  vec2 edge_y = f.dy * size;
  float a = edge_x.x * edge_x.x + edge_y.x * edge_y.x;
  float b = edge_x.x * edge_x.y + edge_y.x * edge_y.y;
  float c = edge_x.y * edge_x.y + edge_y.y * edge_y.y;
  float root = length(vec2(a - c, 2.0 * b));
  float major = sqrt(max(0.5 * (a + c + root), 1e-24));
  // Area over longer radius, because the difference of the roots would cancel.
  float minor = abs(edge_x.x * edge_y.y - edge_x.y * edge_y.x) / major;
  float width = max(minor, 1.0);  // no texel is finer than the finest
  int count = probesHere(clamp(int(ceil(2.0 * major / width - 1.0)), 1, most_probes));
  width = max(width, 2.0 * major / float(count + 1));
  // The eigenvector, from the row without cancellation.
  vec2 along = a >= c ? vec2(0.5 * (a - c + root), b) : vec2(b, 0.5 * (c - a + root));
  along = root > 0.0 ? normalize(along) : vec2(1.0, 0.0);
  float reach = max(major - width, 0.0);  // of the outermost probes
  Probes p = Probes(count, log2(width), along * reach / size, 2.0 * reach / (major + width), 1.0);
  float sum = 0.0;
  for (int i = 0; i < count; ++i) sum += probeWeight(p, i);
  p.whole = sum;
  return p;
}

vec2 probeUv(Footprint f, Probes p, int i) { return f.uv + p.axis * probeAxis(p, i); }
#else
Probes probesOf(vec2 size, Footprint f) { return Probes(1, levelOf(size, f, 1.0)); }
vec2 probeUv(Footprint f, Probes p, int i) { return f.uv; }
float probeWeight(Probes p, int i) { return 1.0; }
#endif
#endif
