// Writes a shadow map: linear depth along its axis, with the alpha test.
in float depth;
#if ALPHA_MASK
in vec2 uv0;
in vec2 uv1;
#if VERTEX_COLOR
in float vertex_alpha;
#endif

#include "alpha_mask.glsl"
#endif

void main() {
#if ALPHA_MASK
  if (isCutOut()) discard;
#endif
  gl_FragDepth = depth;
}
