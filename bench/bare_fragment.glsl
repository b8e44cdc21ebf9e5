#version 450 core
// One fetch, one GGX lobe (Walter 2007, equation 33), one light.
in vec3 position;
in vec3 normal;
in vec4 tangent;
in vec2 uv;

layout(location = 0) out vec4 radiance;
layout(binding = 0) uniform sampler2D normal_map;

uniform vec3 camera_position;
uniform vec3 to_light;

void main() {
  vec3 bump = textureLod(normal_map, uv, 0.0).xyz;
  vec3 across = tangent.w * cross(normal, tangent.xyz);
  vec3 n = normalize(bump.x * tangent.xyz + bump.y * across + bump.z * normal);
  vec3 h = normalize(to_light + normalize(camera_position - position));
  float c = max(dot(n, h), 0.0);
  const float a2 = 0.01;
  float d = c * c * (a2 - 1.0) + 1.0;
  radiance = vec4(vec3(a2 / (3.14159265 * d * d)), 1.0);
}
