// Reads the moments of SlopeVariant::full: mean slope, three second moments and, if it is stored, the mean normal.
#include "footprint_slopes.glsl"

mat2 spreadOf(vec4 moments, vec4 rest) { return slopeCovariance(moments.xy, vec3(moments.z, rest.x, moments.w)); }

vec3 meanNormalOf(vec4 rest) { return rest.yzw; }

#if NORMAL_VARIATION
void fetchSlopes(Footprints f, out vec4 moments, out vec4 rest) {
  fetchPair(slope_moments, slope_rest, f.normal, moments, rest);
}
#endif

#if NORMAL_LAYERS
void fetchLayer(Footprints f, out vec4 moments, out vec4 rest) {
  fetchPair(layer_moments, layer_rest, f.layer, moments, rest);
}
#endif
