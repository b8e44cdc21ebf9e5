// The forward pass: linear radiance towards the camera, coverage in alpha. Everything that all methods share is here.
// The method's module takes the place of the line `module`.
in vec3 world_position;
in vec3 world_normal;
in vec4 world_tangent;
in vec2 uv0;
in vec2 uv1;
//? if surface_coordinates
in vec2 surface_uv;
//? end

layout(location = 0) out vec4 radiance_coverage;

uniform vec3 camera_position;
//? if surface_coordinates
uniform mat3 world_to_camera;
//? end
//? if orthographic
uniform vec3 to_camera;
//? end
//? if not sampling_frame
uniform ivec2 sample_origin;  // of this tile in the whole picture's sample grid
uniform uvec2 sample_seed;    // seed and pass
bool nothing_to_shade = false;  // set by a module whose sample fell on an invalid texel
//? end

//? module
Footprint footprintOf(vec4 linear, vec4 offset_set) {
  vec2 mapped = mat2(linear.xy, linear.zw) * (offset_set.z < 0.5 ? uv0 : uv1) + offset_set.xy;
  return Footprint(mapped, dFdx(mapped), dFdy(mapped));
}

Footprints pixelFootprints() {
  Footprints f;
  f.normal = footprintOf(uv_linear[0], uv_offset_set[0]);
//? if shared_coordinates
  f.roughness = f.normal;
  f.base_color = f.normal;
//? if specular_variation
  f.specular = f.normal;
//? end
//? else
  f.roughness = footprintOf(uv_linear[1], uv_offset_set[1]);
  f.base_color = footprintOf(uv_linear[2], uv_offset_set[2]);
//? if specular_variation
  f.specular = footprintOf(specular_uv_linear, specular_uv_offset_set);
//? end
//? end
//? if surface_coordinates
  f.surface = Footprint(surface_uv, dFdx(surface_uv), dFdy(surface_uv));
//? end
//? if normal_layers
  f.layer = footprintOf(uv_linear[3], uv_offset_set[3]);
//? end
  return f;
}

//? if random_draws
//? include random_numbers.glsl

// Of each number `draw` of a sample, others.
uvec3 drawBits(uint draw) {
  uvec2 pixel = uvec2(ivec2(gl_FragCoord.xy) + sample_origin);
  return hashed(uvec3(pixel, sample_seed.y) ^ hashed(uvec3(sample_seed.x, 0x9e3779b9u + draw, sample_seed.y)));
}

vec2 drawTexelOffsets() {
  return vec2(drawBits(0u).xy >> 8u) * (1.0 / 16777216.0);  // 24 bits: exact in a float, below 1
}
//? end

//? include tangent_frame.glsl

struct SurfacePoint {
  Effective effective;
  Surface surface;
  mat3 frame;
  vec3 wo;  // tangent frame
};

// f * cos of both terms together.
vec3 reflectance(Effective e, Surface s, vec3 wi, vec3 wo) {
  Reflected r = shade(e, s, wi, wo);
//? if diffuse
  return r.specular + r.diffuse;
//? else
  return r.specular;
//? end
}

// One light's share. A light below the surface's own horizon does not reach it.
vec3 reflected(SurfacePoint p, vec3 to_light, vec3 irradiance_at_normal) {
  vec3 wi = to_light * p.frame;
  if (wi.z <= 0.0) return vec3(0.0);
  return reflectance(p.effective, p.surface, wi, p.wo) * irradiance_at_normal;
}

//? if cast_shadow
//? include facet_normal.glsl
vec3 seen_facet;  // of the pixel

//? end
//? if environment_sampled
//? include environment_sampling.glsl
//? elif environment_light
//? include environment_stack.glsl
//? end

vec3 lit(SurfacePoint p) {
  vec3 radiance = vec3(0.0);
//? if point_light
  for (int i = 0; i < point_light_count; ++i) {
    vec3 d = point_lights[i].position_range.xyz - world_position;
    float d2 = dot(d, d);
    float attenuation = distanceAttenuation(d2, point_lights[i].position_range.w);
//? if cast_shadow
    attenuation *= clearOfShadow(point_lights[i].intensity.w, world_position, seen_facet, -d);
//? end
    radiance += reflected(p, d * inversesqrt(max(d2, 1e-24)), point_lights[i].intensity.rgb * attenuation);
  }
//? end
//? if spot_light
  for (int i = 0; i < spot_light_count; ++i) {
    vec3 d = spot_lights[i].position_range.xyz - world_position;
    float d2 = dot(d, d);
    vec3 to_light = d * inversesqrt(max(d2, 1e-24));
    float angular = clamp(-dot(spot_lights[i].direction.xyz, to_light) * spot_lights[i].cone.x + spot_lights[i].cone.y, 0.0, 1.0);
    float attenuation = distanceAttenuation(d2, spot_lights[i].position_range.w) * angular * angular;
//? if cast_shadow
    attenuation *= clearOfShadow(spot_lights[i].intensity.w, world_position, seen_facet, -d);
//? end
    radiance += reflected(p, to_light, spot_lights[i].intensity.rgb * attenuation);
  }
//? end
//? if directional_light
  for (int i = 0; i < directional_light_count; ++i) {
    vec3 irradiance = directional_lights[i].illuminance.rgb;
//? if cast_shadow
    irradiance *= clearOfShadow(directional_lights[i].illuminance.w, world_position, seen_facet, vec3(0.0));
//? end
    radiance += reflected(p, directional_lights[i].to_light.xyz, irradiance);
  }
//? end
//? if environment_light
  radiance += environmentLit(p.effective, p.surface, p.wo, p.frame);
//? end
  return radiance;
}

void main() {
  Footprints f = pixelFootprints();
//? if cast_shadow
  vec3 along_x = dFdx(world_position);  // before any pixel is discarded
  vec3 along_y = dFdy(world_position);
//? end
//? if random_draws
  texel_draw = drawTexelOffsets();
//? end
//? if material_index
  float share = fetch(material_share, footprintOf(share_uv_linear, share_uv_offset_set)).r;
//? end
  vec4 base_color = base_color_factor;
//? if base_color_variation
  base_color *= fetch(base_color_map, f.base_color);
//? end
//? if alpha_mask
  if (base_color.a < lobe_cutoff.y) discard;
//? end
//? if material_index
  if (share <= 0.0) {
    radiance_coverage = vec4(0.0, 0.0, 0.0, share_uv_offset_set.w);
    return;
  }
//? end
  float metallic = dielectric_specular_metallic.w;
//? if metallic_variation
  metallic = fetch(metallic_map, f.roughness).r;
//? end
  vec3 dielectric_specular = dielectric_specular_metallic.rgb;
//? if specular_variation
  dielectric_specular *= fetch(specular_map, f.specular).rgb;
//? end
  SurfacePoint p;
//? if double_sided
  p.frame = tangentFrame(gl_FrontFacing ? world_normal : -world_normal, world_tangent);
//? else
  p.frame = tangentFrame(world_normal, world_tangent);
//? end
//? if surface_coordinates
  tangent_to_camera = world_to_camera * p.frame;
//? end
  p.effective = effective(f);
//? if not sampling_frame
  if (nothing_to_shade) {
    radiance_coverage = vec4(0.0, 0.0, 0.0, 2.0);  // covered, without radiance: resolve_samples.glsl
    return;
  }
//? end
  p.surface.albedo = base_color.rgb * (1.0 - metallic);
  p.surface.f0 = mix(dielectric_specular, base_color.rgb, metallic);
//? if orthographic
  vec3 to_viewer = to_camera;
//? else
  vec3 to_viewer = normalize(camera_position - world_position);
//? end
  p.wo = to_viewer * p.frame;
//? if cast_shadow
  seen_facet = facetNormal(along_x, along_y, to_viewer);
//? end
//? if material_index
  radiance_coverage = vec4(share * lit(p), share_uv_offset_set.w);
//? else
  radiance_coverage = vec4(lit(p), 1.0);
//? end
}
