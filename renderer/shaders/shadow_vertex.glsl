// Transforms vertices to a shadow map. Depth is linear and written by the fragment stage, so z = 0 avoids clipping.
layout(location = 0) in vec3 in_position;
#if ALPHA_MASK
layout(location = 3) in vec2 in_uv0;
layout(location = 4) in vec2 in_uv1;
out vec2 uv0;
out vec2 uv1;
#if VERTEX_COLOR
layout(location = 11) in vec4 in_color;
out float vertex_alpha;
#endif
#endif

uniform mat4 world_to_map;

out float depth;

void main() {
  vec4 on_map = world_to_map * vec4(in_position, 1.0);
#if ALPHA_MASK
  uv0 = in_uv0;
  uv1 = in_uv1;
#if VERTEX_COLOR
  vertex_alpha = in_color.a;
#endif
#endif
  depth = on_map.z;
  gl_Position = vec4(2.0 * on_map.xy - on_map.w, 0.0, on_map.w);
}
