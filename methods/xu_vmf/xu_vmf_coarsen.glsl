// The later passes of the frame build: compute one level of some layers from the next finer level.
#include "xu_vmf_storing.glsl"

layout(location = 0) out vec4 coarse[layer_count];

uniform int first_layer;
layout(binding = 0) uniform sampler2DArray map;  // its base level is the finer level

void main() {
  ivec2 target = ivec2(gl_FragCoord.xy);
  ivec2 size = textureSize(map, 0).xy;
  vec3 across = sharesOf(target.x, size.x);
  vec3 down = sharesOf(target.y, size.y);
  ivec2 taps = min(size, 2 + size % 2);
  vec4 sums[layer_count];
  for (int i = 0; i < layer_count; ++i) {
    sums[i] = vec4(0.0);
    if (isSumOfNext(i, layer_count)) continue;
    for (int y = 0; y < taps.y; ++y) {
      for (int x = 0; x < taps.x; ++x) {
        sums[i] += across[x] * down[y] * texelFetch(map, ivec3(2 * target + ivec2(x, y), first_layer + i), 0);
      }
    }
  }
  for (int i = 0; i < layer_count; ++i) coarse[i] = stored(isSumOfNext(i, layer_count) ? sums[i + 1] + sums[i + 2] : sums[i]);
}
