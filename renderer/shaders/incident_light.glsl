// Light from one source at a pixel: values that are common to all that is shaded there.
struct Incident {
  vec3 wi;  // tangent frame
  vec3 irradiance_at_normal;
#if SCREEN_DERIVATIVES
  vec4 source;  // world space: a point (w 1) or a direction (w 0)
#endif
};

Incident incident(vec3 wi, vec3 irradiance_at_normal, vec4 source) {
#if SCREEN_DERIVATIVES
  return Incident(wi, irradiance_at_normal, source);
#else
  return Incident(wi, irradiance_at_normal);
#endif
}

// Whether light from a direction of the tangent frame reaches the facets under the horizon rule of the scene
// (docs/explanation/base-brdf.md, Horizon). The zero vector means no direction.
bool reachesFacets(vec3 wi) {
#if HORIZON_OPEN
  return dot(wi, wi) > 0.0;
#else
  return wi.z > 0.0;
#endif
}

#if POINT_LIGHT
Incident incidentPoint(int i, mat3 frame) {
  vec3 d = point_lights[i].position_range.xyz - world_position;
  float d2 = dot(d, d);
  float attenuation = distanceAttenuation(d2, point_lights[i].position_range.w);
#if CAST_SHADOW
  attenuation *= clearOfShadow(point_lights[i].intensity.w, world_position, seen_facet, -d);
#endif
  return incident((d * inversesqrt(max(d2, 1e-36))) * frame, point_lights[i].intensity.rgb * attenuation,
                  vec4(point_lights[i].position_range.xyz, 1.0));
}
#endif

#if SPOT_LIGHT
Incident incidentSpot(int i, mat3 frame) {
  vec3 d = spot_lights[i].position_range.xyz - world_position;
  float d2 = dot(d, d);
  vec3 to_light = d * inversesqrt(max(d2, 1e-36));
  float angular =
      clamp(-dot(spot_lights[i].direction.xyz, to_light) * spot_lights[i].cone.x + spot_lights[i].cone.y, 0.0, 1.0);
  float attenuation = distanceAttenuation(d2, spot_lights[i].position_range.w) * angular * angular;
#if CAST_SHADOW
  attenuation *= clearOfShadow(spot_lights[i].intensity.w, world_position, seen_facet, -d);
#endif
  return incident(to_light * frame, spot_lights[i].intensity.rgb * attenuation,
                  vec4(spot_lights[i].position_range.xyz, 1.0));
}
#endif

#if DIRECTIONAL_LIGHT
Incident incidentDirectional(int i, mat3 frame) {
  vec3 irradiance = directional_lights[i].illuminance.rgb;
#if CAST_SHADOW
  irradiance *= clearOfShadow(directional_lights[i].illuminance.w, world_position, seen_facet, vec3(0.0));
#endif
  return incident(directional_lights[i].to_light.xyz * frame, irradiance,
                  vec4(directional_lights[i].to_light.xyz, 0.0));
}
#endif

#if AREA_POINTS
// A point of an area light, as bright as its share of the light.
Incident incidentAreaPoint(int i, mat3 frame) {
  AreaLight light = areaLight(int(area_points[i].w), world_position);
  vec3 point = areaPoint(i, light), d = point - world_position;
  float spread = areaSpread(light, d);
  float attenuation = spread > 0.0 ? light.share.x / max(spread, 1e-36) : 0.0;
#if CAST_SHADOW
  attenuation *= clearOfShadow(light.intensity.w, world_position, seen_facet, world_position - light.position_area.xyz);
#endif
  return incident((d * inversesqrt(max(dot(d, d), 1e-36))) * frame, light.intensity.rgb * attenuation,
                  vec4(point, 1.0));
}
#endif
