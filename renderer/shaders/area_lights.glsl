// Area lights: rectangles and disks that shine to one side, and spheres, with equal radiance in all directions
// (docs/explanation/area-lights.md).
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

bool isSphere(AreaLight light) { return light.direction_shape.w < -0.5; }

// The disk that covers a sphere seen from `position`: the circle on which rays from there touch the sphere. Positions
// within the sphere get no light.
AreaLight facingDisk(AreaLight sphere, vec3 position) {
  vec3 d = sphere.position_area.xyz - position;
  float radius = sphere.across_half.w, size = length(d);
  float cosine2 = max((size - radius) * (size + radius) / max(size * size, 1e-36), 0.0);  // of the cone's half angle
  vec3 towards = size > 0.0 ? d / size : vec3(0.0, 0.0, 1.0);
  vec3 other = abs(towards.z) < 0.9 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0);
  vec3 across = normalize(cross(towards, other));
  AreaLight disk = sphere;
  disk.position_area = vec4(position + cosine2 * d, cosine2 * sphere.position_area.w);
  disk.across_half = vec4(across, radius * sqrt(cosine2));
  disk.up_half = vec4(cross(across, towards), radius * sqrt(cosine2));
  disk.direction_shape.xyz = cosine2 > 0.0 ? -towards : towards;
  disk.intensity.rgb *= cosine2;
  return disk;
}

// Light `number` as seen from `position`.
AreaLight areaLight(int number, vec3 position) {
  AreaLight light = area_lights[number];
  return isSphere(light) ? facingDisk(light, position) : light;
}

#if AREA_POINTS
// Points of lights, each with an equal share of its light's area; w: the number of the light.
layout(std140, binding = 8) uniform AreaPoints { vec4 area_points[area_point_capacity]; };
#if !FIXED_TRIPS
uniform int area_point_count;
#endif

// Point i of a light from areaLight.
vec3 areaPoint(int i, AreaLight light) {
  if (!isSphere(light)) return area_points[i].xyz;
  AreaLight sphere = area_lights[int(area_points[i].w)];  // with the disk whose points they are
  vec3 offset = area_points[i].xyz - sphere.position_area.xyz;
  vec2 at = vec2(dot(offset, sphere.across_half.xyz), dot(offset, sphere.up_half.xyz)) / max(sphere.across_half.w, 1e-30);
  at *= min(inversesqrt(max(dot(at, at), 1e-30)), 1.0);
  return light.position_area.xyz + light.across_half.w * (at.x * light.across_half.xyz + at.y * light.up_half.xyz);
}
#endif

// Squared distance over the cosine at the light, to a point of it that is `d` away: density over solid angle of points
// that are even over the area, times the area. 0: the light does not shine there.
float areaSpread(AreaLight light, vec3 d) {
  float d2 = dot(d, d);
  float facing = -dot(light.direction_shape.xyz, d);
  return facing > 0.0 ? d2 * sqrt(d2) / facing : 0.0;
}
