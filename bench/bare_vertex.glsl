#version 450 core
layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec4 in_tangent;
layout(location = 3) in vec2 in_uv;

uniform mat4 world_to_clip;

out vec3 position;
out vec3 normal;
out vec4 tangent;
out vec2 uv;

void main() {
  position = in_position;
  normal = in_normal;
  tangent = in_tangent;
  uv = in_uv;
  gl_Position = world_to_clip * vec4(in_position, 1.0);
}
