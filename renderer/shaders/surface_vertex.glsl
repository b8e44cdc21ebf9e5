// Transforms vertices to clip space; passes position and frame in world space.
layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec4 in_tangent;
layout(location = 3) in vec2 in_uv0;
layout(location = 4) in vec2 in_uv1;
#if SURFACE_COORDINATES
layout(location = 5) in vec2 in_surface;
#endif
#if ENVIRONMENT_VISIBILITY
layout(location = 6) in vec4 in_visibility_weights[4];
layout(location = 10) in vec4 in_visible_diffuse;
#endif
#if VERTEX_COLOR
layout(location = 11) in vec4 in_color;
#endif

uniform mat4 world_to_clip;

out vec3 world_position;
out vec3 world_normal;
out vec4 world_tangent;
out vec2 uv0;
out vec2 uv1;
#if SURFACE_COORDINATES
out vec2 surface_uv;
#endif
#if ENVIRONMENT_VISIBILITY
out vec4 visibility_weights[4];
out vec4 visible_diffuse;
#endif
#if VERTEX_COLOR
out vec4 vertex_color;
#endif

void main() {
  world_position = in_position;
  world_normal = in_normal;
  world_tangent = in_tangent;
  uv0 = in_uv0;
  uv1 = in_uv1;
#if SURFACE_COORDINATES
  surface_uv = in_surface;
#endif
#if ENVIRONMENT_VISIBILITY
  visibility_weights = in_visibility_weights;
  visible_diffuse = in_visible_diffuse;
#endif
#if VERTEX_COLOR
  vertex_color = in_color;
#endif
  gl_Position = world_to_clip * vec4(in_position, 1.0);
}
