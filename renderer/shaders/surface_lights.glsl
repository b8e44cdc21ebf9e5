// Punctual lights in the units of KHR_lights_punctual: candela and lux. Their counts are uniforms: one program serves any
// number of lights. llvmpipe knows their values when it compiles, and unrolls loops over few lights and little else.

//? if point_light
struct PointLight {
  vec4 position_range;  // range 0: unlimited
  vec4 intensity;       // w: the light's first shadow map
};
layout(std140, binding = 2) uniform PointLights { PointLight point_lights[point_light_capacity]; };
uniform int point_light_count;
//? end
//? if spot_light
struct SpotLight {
  vec4 position_range;
  vec4 intensity;  // w: as above
  vec4 direction;
  vec4 cone;  // scale and offset of KHR_lights_punctual's angular attenuation
};
layout(std140, binding = 3) uniform SpotLights { SpotLight spot_lights[spot_light_capacity]; };
uniform int spot_light_count;
//? end
//? if directional_light
struct DirectionalLight {
  vec4 to_light;
  vec4 illuminance;  // w: as above
};
layout(std140, binding = 4) uniform DirectionalLights { DirectionalLight directional_lights[directional_light_capacity]; };
uniform int directional_light_count;
//? end

// Inverse square, windowed where the light has a range (KHR_lights_punctual).
float distanceAttenuation(float squared_distance, float range) {
  float falloff = 1.0 / max(squared_distance, 1e-12);
  if (range <= 0.0) return falloff;
  float ratio = squared_distance / (range * range);
  return falloff * clamp(1.0 - ratio * ratio, 0.0, 1.0);
}
