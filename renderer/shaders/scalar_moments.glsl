// Reads the moments of SlopeVariant::scalar: mean slope, E[b.b] and, for a diffuse term without layers, the mean normal.
#include "footprint_slopes.glsl"

// A round covariance, the variance per axis from E[b.b] instead of M.
mat2 spreadOf(vec4 moments, vec4 rest) {
  return mat2(max(0.5 * (moments.z - dot(moments.xy, moments.xy)), 0.0));
}

vec3 meanNormalOf(vec4 rest) { return rest.xyz; }

#if NORMAL_VARIATION
void fetchSlopes(Footprints f, out vec4 moments, out vec4 rest) {
#if DIFFUSE && !NORMAL_LAYERS
  fetchPair(slope_moments, slope_rest, f.normal, moments, rest);
#else
  moments = fetch(slope_moments, f.normal);
  rest = vec4(0.0);
#endif
}
#endif

#if NORMAL_LAYERS
void fetchLayer(Footprints f, out vec4 moments, out vec4 rest) {
  moments = fetch(layer_moments, f.layer);
  rest = vec4(0.0);
}
#endif
