// Draws triangles in texture space, with the surface data that the lobe of a texel needs.
layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec4 in_tangent;
layout(location = 3) in vec2 in_uv0;
layout(location = 4) in vec2 in_uv1;
layout(location = 5) in vec2 in_surface;

out vec3 world_position;
out vec3 world_normal;
out vec4 world_tangent;
out vec2 uv0;
out vec2 uv1;

void main() {
  world_position = in_position;
  world_normal = in_normal;
  world_tangent = in_tangent;
  uv0 = in_uv0;
  uv1 = in_uv1;
  gl_Position = vec4(2.0 * in_surface - 1.0, 0.0, 1.0);
}
