// Second pass of the frame build: from the finest level, with one lobe per texel, to the next level of some parts. The
// finest level of parts is not stored, because the direction of a texel's lobe gives its part.
#include "xu_vmf_cells.glsl"
#include "xu_vmf_storing.glsl"

layout(location = 0) out vec4 part[layer_count];

uniform int source;      // the layer to split
uniform int first_part;  // the first drawn part
layout(binding = 0) uniform sampler2DArray finest;
#if GUARD
layout(binding = 1) uniform sampler2DArray values;
#endif

void main() {
  vec4 sums[layer_count];
  for (int i = 0; i < layer_count; ++i) sums[i] = vec4(0.0);
  ivec2 target = ivec2(gl_FragCoord.xy);
  ivec2 size = textureSize(finest, 0).xy;
  vec3 across = sharesOf(target.x, size.x);
  vec3 down = sharesOf(target.y, size.y);
  ivec2 taps = min(size, 2 + size % 2);
  for (int y = 0; y < taps.y; ++y) {
    for (int x = 0; x < taps.x; ++x) {
      ivec3 texel = ivec3(2 * target + ivec2(x, y), source);
      vec4 r = texelFetch(finest, texel, 0);
      if (r.w == 0.0) continue;
      int own = partOfCell(cellOf(r.xyz));
      vec4 value = across[x] * down[y] * r;
#if GUARD
      value = across[x] * down[y] * texelFetch(values, texel, 0);
#endif
      for (int i = 0; i < layer_count; ++i) {
        if (!isSumOfNext(i, layer_count)) sums[i] += own == first_part + i ? value : vec4(0.0);
      }
    }
  }
  for (int i = 0; i < layer_count; ++i) part[i] = stored(isSumOfNext(i, layer_count) ? sums[i + 1] + sums[i + 2] : sums[i]);
}
