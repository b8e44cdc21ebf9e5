// Area lights for the reference. Each sample draws points of every light, and directions from the lobe of the module,
// weighted by the balance heuristic (Veach and Guibas 1995).

#include "area_points.glsl"

// Whether a ray from the pixel meets the light; `d` is the way to the point where it does.
bool meetsArea(AreaLight light, vec3 direction, out vec3 d) {
  vec3 centre = light.position_area.xyz - world_position;
  float facing = dot(light.direction_shape.xyz, direction);
  float distance_along = dot(light.direction_shape.xyz, centre) / min(facing, -1e-12);
  d = distance_along * direction;
  if (facing >= 0.0 || distance_along <= 0.0) return false;
  vec2 at = vec2(dot(d - centre, light.across_half.xyz) / max(light.across_half.w, 1e-30),
                 dot(d - centre, light.up_half.xyz) / max(light.up_half.w, 1e-30));
  return light.direction_shape.w > 0.5 ? max(abs(at.x), abs(at.y)) < 1.0 : dot(at, at) < 1.0;
}

// The light that a direction to the light adds, over the sum of both densities. A light without area has that of its
// point.
vec3 weighedArea(SurfacePoint p, AreaLight light, vec3 wi, float spread) {
  if (spread <= 0.0 || !reachesFacets(wi)) return vec3(0.0);
  return reflectance(p, wi) * light.intensity.rgb / (spread + light.position_area.w * lobeDirectionDensity(p, wi));
}

vec3 areaLightIntegral(SurfacePoint p, int number) {
  AreaLight light = areaLight(number, world_position);
  vec3 centre = light.position_area.xyz - world_position;
  float seen = 1.0;
#if CAST_SHADOW
  seen = clearOfShadow(light.intensity.w, world_position, seen_facet, -centre);
  if (seen <= 0.0) return vec3(0.0);
#endif
  uvec3 seed = hashed(sample_pixel ^ uvec3(0x9e3779b9u * uint(number + 1)));
  uvec3 lobe_seed = hashed(seed);
  int count = max(directions_per_sample / int(drawn_texels.z), 1);
  int i = sample_texel * count;
  int end = i + count;
  vec3 radiance = vec3(0.0);
  do {
    uvec4 digits = cell_directions[sample_cell] ^ direction_steps[i];
    vec2 at = drawnAreaPoint(light.direction_shape.w > 0.5, scrambledPair(digits.xy, seed.xy));
    vec3 d = centre + at.x * light.across_half.w * light.across_half.xyz + at.y * light.up_half.w * light.up_half.xyz;
    radiance += weighedArea(p, light, d * inversesqrt(max(dot(d, d), 1e-36)) * p.frame, areaSpread(light, d));
    float choice = unitInterval(scrambled(cell_choices[sample_cell] ^ choice_steps[i], seed.z));
    vec3 wi = lobeDirection(p, vec3(scrambledPair(digits.zw, lobe_seed.xy), choice));
    if (dot(wi, wi) > 0.0 && meetsArea(light, p.frame * wi, d))
      radiance += weighedArea(p, light, wi, areaSpread(light, d));
  } while (++i < end);
  return radiance * (seen / float(count));
}

vec3 areaIntegral(SurfacePoint p) {
  vec3 radiance = vec3(0.0);
  int number = 0;
  do {
    radiance += areaLightIntegral(p, number);
  } while (number++ < area_light_count - 1);
  return radiance;
}
