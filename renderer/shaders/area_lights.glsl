// Area lights: rectangles and disks that shine to one side with equal radiance in all directions (docs/explanation/area-lights.md).
struct AreaLight {
  vec4 position_area;
  vec4 across_half;      // unit, along two edges; w: from the centre to the edges, or the radius
  vec4 up_half;          // the same for the other edges
  vec4 direction_shape;  // where it shines, unit; w: AreaShape in scene.hpp
  vec4 intensity;        // radiance times area; w: the light's shadow map, from its centre
  vec4 share;            // x: of each of its points
};
layout(std140, binding = 7) uniform AreaLights { AreaLight area_lights[area_light_capacity]; };
#if !FIXED_TRIPS
uniform int area_light_count;
#endif

// Light `number` as seen from `position`.
AreaLight areaLight(int number, vec3 position) { return area_lights[number]; }

#if AREA_POINTS
// Points of lights, each with an equal share of its light's area; w: the number of the light.
layout(std140, binding = 8) uniform AreaPoints { vec4 area_points[area_point_capacity]; };
#if !FIXED_TRIPS
uniform int area_point_count;
#endif

// Point i of a light from areaLight.
vec3 areaPoint(int i, AreaLight light) { return area_points[i].xyz; }
#endif

// Squared distance over the cosine at the light, to a point of it that is `d` away: density over solid angle of points
// that are even over the area, times the area. 0: the light does not shine there.
float areaSpread(AreaLight light, vec3 d) {
  float d2 = dot(d, d);
  float facing = -dot(light.direction_shape.xyz, d);
  return facing > 0.0 ? d2 * sqrt(d2) / facing : 0.0;
}
