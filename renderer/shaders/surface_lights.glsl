// Punctual lights in the units of KHR_lights_punctual: candela and lux. Counts are uniforms, so one program serves any.

#if POINT_LIGHT
struct PointLight {
  vec4 position_range;  // range 0: unlimited
  vec4 intensity;       // w: the light's first shadow map
};
layout(std140, binding = 2) uniform PointLights { PointLight point_lights[point_light_capacity]; };
#if !FIXED_TRIPS
uniform int point_light_count;
#endif
#endif
#if SPOT_LIGHT
struct SpotLight {
  vec4 position_range;
  vec4 intensity;  // w: as above
  vec4 direction;
  vec4 cone;  // scale and offset of KHR_lights_punctual's angular attenuation
};
layout(std140, binding = 3) uniform SpotLights { SpotLight spot_lights[spot_light_capacity]; };
#if !FIXED_TRIPS
uniform int spot_light_count;
#endif
#endif
#if DIRECTIONAL_LIGHT
struct DirectionalLight {
  vec4 to_light;
  vec4 illuminance;  // w: as above
};
layout(std140, binding = 4) uniform DirectionalLights { DirectionalLight directional_lights[directional_light_capacity]; };
#if !FIXED_TRIPS
uniform int directional_light_count;
#endif
#endif

#if AREA_LIGHT
#include "area_lights.glsl"

#endif
// Inverse square falloff, windowed if the light has a range (KHR_lights_punctual).
float distanceAttenuation(float squared_distance, float range) {
  float falloff = 1.0 / max(squared_distance, 1e-36);
  if (range <= 0.0) return falloff;
  float ratio = squared_distance / (range * range);
  return falloff * clamp(1.0 - ratio * ratio, 0.0, 1.0);
}

#if CAST_SHADOW && (POINT_LIGHT || SPOT_LIGHT || DIRECTIONAL_LIGHT || AREA_LIGHT)
// Large-scale visibility of point, spot and directional lights: shadow maps (docs/explanation/shadows.md).
struct ShadowView {
  mat4 world_to_map;    // to (u w, v w, linear depth, w)
  vec4 axis_texel;      // where the map looks; edge of a texel in metres at w = 1
  vec4 faces_rounding;  // maps of the light: 1 or 6; what rounding moves a point by, metres
};
layout(std140, binding = 6) uniform ShadowViews { ShadowView shadow_views[shadow_view_capacity]; };

// The face of a cube that a direction intersects, in the order +x, -x, +y, -y, +z, -z.
int cubeFace(vec3 direction) {
  vec3 size = abs(direction);
  int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
  return 2 * axis + (direction[axis] < 0.0 ? 1 : 0);
}

// The unoccluded share of a light at a point: four texel comparisons, blended. A comparison reads the surface up to
// sqrt(2) texels away, so the point is first moved along its geometric normal `n` in front of its own plane there, plus
// a margin for rounding. `from_light`: from the light to the point, for lights with six maps.
float clearOfShadow(float first_view, vec3 point, vec3 n, vec3 from_light) {
  int view = int(first_view);
  if (shadow_views[view].faces_rounding.x > 1.0) view += cubeFace(from_light);
  vec4 axis_texel = shadow_views[view].axis_texel;
  float along = dot(n, axis_texel.xyz);
  float texel = axis_texel.w * (shadow_views[view].world_to_map * vec4(point, 1.0)).w;
  float moved = 1.45 * texel * sqrt(max(1.0 - along * along, 0.0)) + shadow_views[view].faces_rounding.y;
  vec4 on_map = shadow_views[view].world_to_map * vec4(point + moved * n, 1.0);
  return texture(shadow_maps, vec4(on_map.xy / on_map.w, float(view), on_map.z));
}
#endif
