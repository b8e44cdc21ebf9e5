// The mean of the unit normals under a footprint, from the texture of `bake_mean_normal`, whose storage decides how it is
// read: its direction (that of the surface if it is zero) and its length, at most 1.
#if NORMAL_LAYERS
#include "normal_layers.glsl"
#endif

#include "length_shortfall.glsl"

// For 16 bits, half a unit in the last place. The loss of 8 bits is too large to correct.
#if HALF_NORMALS
const float length_rounding = 1.0 / 2048.0;
#elif COARSE_NORMALS
const float length_rounding = 0.0;
#else
const float length_rounding = rounding_of_floats;
#endif

vec4 storedMeanNormal(vec3 mean) {
#if COARSE_NORMALS
  mean = 2.0 * mean - 1.0;
#endif
#if TWO_CHANNEL_NORMALS
  mean.z = sqrt(max(1.0 - dot(mean.xy, mean.xy), 0.0));  // of unit normals, of which only x and y are stored
#endif
  float size = length(mean);
  return vec4(size > 1e-6 ? mean / size : vec3(0.0, 0.0, 1.0), 1.0 - shortfallOfLength(size, length_rounding));
}

vec4 meanNormal(Footprints f) {
#if NORMAL_VARIATION
  vec4 normal = storedMeanNormal(fetch(mean_normal, f.normal).xyz);
#else
  vec4 normal = vec4(0.0, 0.0, 1.0, 1.0);
#endif
#if NORMAL_LAYERS
  // Slopes of both layers add, and so do their variances (1 - |Na|) / |Na|: 1 / |Na| = 1 / |Na1| + 1 / |Na2| - 1.
  vec4 layer = storedMeanNormal(fetch(mean_layer, f.layer).xyz);
  float size = 1.0 / (1.0 / max(normal.w, 1e-6) + 1.0 / max(layer.w, 1e-6) - 1.0);
  normal = vec4(withSlopesAdded(normal.xyz, layer.xyz), size);
#endif
  return normal;
}
