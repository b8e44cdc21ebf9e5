// Transforms vertices to clip space and passes the identity of the piece of surface.
layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 3) in vec2 in_uv0;
layout(location = 4) in vec2 in_uv1;
layout(location = 5) in vec2 in_piece;  // numbers of the chart, within its material, and of the material, from 1 on
#if ALPHA_MASK && VERTEX_COLOR
layout(location = 11) in vec4 in_color;
#endif

uniform mat4 world_to_clip;

out vec3 world_position;
out vec3 world_normal;
out vec2 uv0;
out vec2 uv1;
flat out vec2 piece;
#if ALPHA_MASK && VERTEX_COLOR
out float vertex_alpha;
#endif

void main() {
  world_position = in_position;
  world_normal = in_normal;
  uv0 = in_uv0;
  uv1 = in_uv1;
  piece = in_piece;
#if ALPHA_MASK && VERTEX_COLOR
  vertex_alpha = in_color.a;
#endif
  gl_Position = world_to_clip * vec4(in_position, 1.0);
}
