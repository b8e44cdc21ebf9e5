// The slopes under the footprint of a pixel, from the textures of `bake_slopes` (renderer/bake/slope_moments.hpp) plus
// a bump layer, and the lobe over them. A module also includes one text that defines the lobe (stretched_slopes.glsl,
// gaussian_slopes.glsl) and one that reads the moments (full_moments.glsl, scalar_moments.glsl), and it defines
// `addedVariance`.
#include "common_slopes.glsl"

// Reads two textures of the same size like `fetch`, in one loop over the probes.
void fetchPair(sampler2D first, sampler2D second, Footprint f, out vec4 of_first, out vec4 of_second) {
#if SAMPLING_FRAME && !FILTER_HARDWARE
  Probes p = probesOf(vec2(textureSize(first, 0)), f);
  countLookups(2 * p.count);
  of_first = vec4(0.0);
  of_second = vec4(0.0);
  int i = 0;
  do {
    vec2 uv = probeUv(f, p, i);
    float weight = probeWeight(p, i);
    of_first += weight * textureLod(first, uv, p.level);
    of_second += weight * textureLod(second, uv, p.level);
  } while (++i < p.count);
#else
  of_first = fetch(first, f);
  of_second = fetch(second, f);
#endif
}

#if NORMAL_VARIATION
// The stored moments of the normal map; of the scalar ones without a mean normal, `rest` is 0.
void fetchSlopes(Footprints f, out vec4 moments, out vec4 rest);

#endif
#if NORMAL_LAYERS
// The stored moments of a bump layer.
void fetchLayer(Footprints f, out vec4 moments, out vec4 rest);

#endif
// The covariance of stored moments.
mat2 spreadOf(vec4 moments, vec4 rest);

// The mean normal next to stored moments, not renormalised; undefined if it is not stored.
vec3 meanNormalOf(vec4 rest);

// The slope variance of the base lobe that the moments do not include.
float addedVariance(Footprints f);

struct FilteredSlopes {
  vec2 mean;
  mat2 spread;       // covariance
  vec3 mean_normal;  // of a normal map without layers, if it is stored
};

FilteredSlopes filteredSlopes(Footprints f) {
  FilteredSlopes s;
  s.mean = vec2(0.0);
  s.spread = mat2(0.0);
  s.mean_normal = vec3(0.0, 0.0, 1.0);
  vec4 moments = vec4(0.0);
  vec4 rest = vec4(0.0);
#if NORMAL_VARIATION
  fetchSlopes(f, moments, rest);
  s.mean = moments.xy;
  s.spread = spreadOf(moments, rest);
  s.mean_normal = meanNormalOf(rest);
#endif
#if NORMAL_LAYERS
  // Slopes of independent layers add, and so do means and covariances; adding these has the least cancellation.
  fetchLayer(f, moments, rest);
  s.mean += moments.xy;
  s.spread += spreadOf(moments, rest);
#endif
  return s;
}

// The lobe over the footprint of a pixel.
SlopeLobe footprintLobe(Footprints f, FilteredSlopes s) { return slopeLobe(s.mean, s.spread, addedVariance(f)); }
