// The forward pass: linear radiance towards the camera, and coverage in alpha, with everything that methods share.
in vec3 world_position;
in vec3 world_normal;
in vec4 world_tangent;
in vec2 uv0;
in vec2 uv1;
in vec2 surface_uv;  //? if surface_coordinates
in vec4 vertex_color;  //? if vertex_color

layout(location = 0) out vec4 radiance_coverage;

uniform vec3 camera_position;
uniform mat3 world_to_camera;  //? if surface_coordinates or screen_derivatives
uniform vec3 to_camera;  //? if orthographic
bool nothing_to_shade = false;  // set by a module whose sample fell on an invalid texel  //? if not sampling_frame

//? module
Footprint footprintOf(vec4 linear, vec4 offset_set) {
  vec2 mapped = mat2(linear.xy, linear.zw) * (offset_set.z < 0.5 ? uv0 : uv1) + offset_set.xy;
  return Footprint(mapped, dFdx(mapped), dFdy(mapped));
}

Footprints pixelFootprints() {
  Footprints f;
  f.normal = footprintOf(uv_linear[0], uv_offset_set[0]);
  f.roughness = f.normal;                                                //? if shared_coordinates
  f.roughness = footprintOf(uv_linear[1], uv_offset_set[1]);             //? else
  f.base_color = f.normal;                                               //? if shared_coordinates
  f.base_color = footprintOf(uv_linear[2], uv_offset_set[2]);            //? else
  f.specular = f.normal;                                                 //? if specular_variation and shared_coordinates
  f.specular = footprintOf(specular_uv_linear, specular_uv_offset_set);  //? elif specular_variation
  f.surface = Footprint(surface_uv, dFdx(surface_uv), dFdy(surface_uv));  //? if surface_coordinates
  f.layer = footprintOf(uv_linear[3], uv_offset_set[3]);  //? if normal_layers
  f.coat_weight = footprintOf(coat_uv_linear[0], coat_uv_offset_set[0]);  //? if clear_coat and coat_weight_variation
  f.coat_width = footprintOf(coat_uv_linear[1], coat_uv_offset_set[1]);  //? if clear_coat and coat_width_variation
  f.coat_normal = footprintOf(coat_uv_linear[2], coat_uv_offset_set[2]);  //? if clear_coat and coat_normal_variation
  f.share = footprintOf(share_uv_linear, share_uv_offset_set);  //? if material_index
  f.emission = footprintOf(emission_uv_linear, emission_uv_offset_set);  //? if emission_variation
  f.occlusion = footprintOf(occlusion_uv_linear, occlusion_uv_offset_set);  //? if occlusion
  return f;
}

//? include sample_draws.glsl if random_draws

//? include tangent_frame.glsl

//? if cast_shadow
//? include facet_normal.glsl
vec3 seen_facet;  // of the pixel

//? end
//? include incident_light.glsl

//? if screen_derivatives
//? include neighbour_pixels.glsl

//? end
//? include footprint_parts.glsl if filter_parts

//? if clear_coat
//? include clear_coat.glsl

//? end
//? include stretch_under.glsl if anisotropic_lobe and anisotropy_variation
// The surface seen through a pixel or a part of it.
struct SurfacePoint {
  Effective effective;
  Surface surface;
  mat3 frame;
  vec3 wo;  // tangent frame
  Coat coat;  //? if clear_coat
};

// f * cos of both terms, and the coat over them.
vec3 withCoat(SurfacePoint p, Reflected r, vec3 wi) {
  vec3 base = r.specular + r.diffuse;  //? if diffuse
  vec3 base = r.specular;              //? else
  return (1.0 - p.coat.share) * base + coatReflectance(p.coat, wi, p.wo);  //? if clear_coat
  return base;                                                             //? else
}

vec3 reflectance(SurfacePoint p, vec3 wi) { return withCoat(p, shade(p.effective, p.surface, wi, p.wo), wi); }

// The contribution of one light.
vec3 reflected(SurfacePoint p, Incident light) {
  if (!reachesFacets(light.wi)) return vec3(0.0);
//? if screen_derivatives
  Reflected r = shade(p.effective, p.surface, light.wi, p.wo, halfSteps(light.wi, light.source, p.wo));
//? else
  Reflected r = shade(p.effective, p.surface, light.wi, p.wo);
//? end
  return withCoat(p, r, light.wi) * light.irradiance_at_normal;
}

//? if directions_drawn and not environment_dense or area_sampled
//? include direction_draws.glsl

//? end
//? include environment_sampling.glsl if environment_sampled
//? include environment_stack.glsl if environment_light and not environment_sampled

//? if area_sampled
//? include area_sampling.glsl

//? end
//? if area_lobes
//? include area_lobes.glsl

//? end
//? if filter_parts
// Evaluates every light once per pixel, independent of the number of parts.
Incident arriving[max(light_capacity, 1)];
int arriving_count = 0;

void add(Incident light) {
  if (reachesFacets(light.wi)) arriving[arriving_count++] = light;
}

void findLight(mat3 frame) {
  for (int i = 0; i < point_light_count; ++i) add(incidentPoint(i, frame));  //? if point_light
  for (int i = 0; i < spot_light_count; ++i) add(incidentSpot(i, frame));  //? if spot_light
  for (int i = 0; i < directional_light_count; ++i) add(incidentDirectional(i, frame));  //? if directional_light
  for (int i = 0; i < area_point_count; ++i) add(incidentAreaPoint(i, frame));  //? if area_points
}
//? end

//? if environment_light and not environment_sampled
// Environment light, by lobes.
vec3 environmentRadiance(SurfacePoint p) {
  vec3 base = environmentSum(p.effective, p.surface, p.wo, p.frame);  //? if environment_summed
  vec3 base = environmentLit(p.effective, p.surface, p.wo, p.frame);  //? else
  return (1.0 - p.coat.share) * base + coatLit(p);  //? if clear_coat
  return base;                                      //? else
}

//? end
float unoccluded;  // the share of the environment's light that the occlusion map leaves  //? if occlusion

vec3 lit(SurfacePoint p) {
  vec3 radiance = vec3(0.0);
//? if filter_parts
  for (int i = 0; i < arriving_count; ++i) radiance += reflected(p, arriving[i]);
//? else
//? if point_light
  int point = 0;
  do {
    radiance += reflected(p, incidentPoint(point, p.frame));
  } while (point++ < point_light_count - 1);
//? end
//? if spot_light
  int spot = 0;
  do {
    radiance += reflected(p, incidentSpot(spot, p.frame));
  } while (spot++ < spot_light_count - 1);
//? end
//? if directional_light
  int directional = 0;
  do {
    radiance += reflected(p, incidentDirectional(directional, p.frame));
  } while (directional++ < directional_light_count - 1);
//? end
//? if area_points
  int area_point = 0;
  do {
    radiance += reflected(p, incidentAreaPoint(area_point, p.frame));
  } while (area_point++ < area_point_count - 1);
//? end
//? end
  radiance += areaIntegral(p);  //? if area_sampled
  radiance += areaLit(p);  //? if area_lobes
  radiance += unoccluded * environmentIntegral(p);  //? if environment_sampled and occlusion
  radiance += environmentIntegral(p);               //? elif environment_sampled
  radiance += unoccluded * environmentRadiance(p);  //? elif environment_light and occlusion
  radiance += environmentRadiance(p);               //? elif environment_light
  radiance += unoccluded * sunRadiance(p);  //? if environment_suns and occlusion
  radiance += sunRadiance(p);               //? elif environment_suns
  return radiance;
}

// Base colour = factor * map * vertex colour (glTF 2.0, sections 3.9.2 and 3.7.2.1).
vec4 baseColor(Footprints f) {
  vec4 color = base_color_factor;
  color *= fetch(base_color_map, f.base_color);  //? if base_color_variation
  color *= vertex_color;  //? if vertex_color
  return color;
}

Surface surfaceUnder(Footprints f, vec3 base_color) {
  float metallic = dielectric_specular_metallic.w;
  metallic = fetch(metallic_map, f.roughness).r;  //? if metallic_variation
  vec3 dielectric_specular = dielectric_specular_metallic.rgb;
  dielectric_specular *= fetch(specular_map, f.specular).rgb;  //? if specular_variation
  return Surface(base_color * (1.0 - metallic), mix(dielectric_specular, base_color, metallic));
}

//? if emitting
// The light that a surface emits through its coat (KHR_materials_clearcoat, Emission).
vec3 emission(Footprints f, SurfacePoint p) {
  vec3 radiance = emitted.rgb;
  radiance *= fetch(emission_map, f.emission).rgb;  //? if emission_variation
  return (1.0 - p.coat.share) * radiance;  //? if clear_coat
  return radiance;                         //? else
}
//? end

//? if alpha_mask
// The alpha test cuts out whole pixels, by the mean alpha over the pixel, which is never drawn at random.
float meanAlpha(Footprints f) {
//? if filter_shaded
  float sum = 0.0;
  int parts = probesHere(partCount());
  for (int i = 0; i < parts; ++i) sum += baseColor(partOf(f, i)).a;
  return sum / float(parts);
//? else
  return baseColor(f).a;
//? end
}
//? end

// The radiance of a footprint, times the share of the material.
vec3 reflectedBy(Footprints f, mat3 frame, vec3 wo) {
//? if material_index
  float share = fetch(material_share, f.share).r;
  if (share <= 0.0) return vec3(0.0);
//? end
  if (lobe_cutoff.z > 0.0) return vec3(0.0);                 //? if unlit and emitting
  if (lobe_cutoff.z > 0.0) return share * baseColor(f).rgb;  //? elif unlit and material_index
  if (lobe_cutoff.z > 0.0) return baseColor(f).rgb;          //? elif unlit
  stretch = stretchUnder(f);  //? if anisotropic_lobe and anisotropy_variation
//? if clear_coat
  SurfacePoint p = SurfacePoint(effective(f), surfaceUnder(f, baseColor(f).rgb), frame, wo, coatUnder(f, wo));
//? else
  SurfacePoint p = SurfacePoint(effective(f), surfaceUnder(f, baseColor(f).rgb), frame, wo);
//? end
  unoccluded = fetch(occlusion_map, f.occlusion).r;  //? if occlusion
  vec3 radiance = lit(p);
  radiance += emission(f, p);  //? if emitting
  return share * radiance;  //? if material_index
  return radiance;          //? else
}

// The mean over the footprint of the pixel.
vec3 meanReflected(Footprints f, mat3 frame, vec3 wo) {
//? if filter_parts
  findLight(frame);
  vec3 sum = vec3(0.0);
  int parts = probesHere(partCount());
  int i = 0;
  do {
    sum += reflectedBy(partOf(f, i), frame, wo);
  } while (++i < parts);
  return sum / float(parts);
//? else
  return reflectedBy(f, frame, wo);
//? end
}

//? if sampling_texel
// The bilinear filter of radiance: the weighted mean over the texels of a sample. Alpha is that of
// resolve_samples.glsl: 1 plus the share of invalid texels.
vec4 meanOverTexels(Footprints f, mat3 frame, vec3 wo) {
  vec3 radiance = vec3(0.0);
  float invalid = 0.0;
  int i = 0;
  do {
    float weight = drawTexel(f.normal, i);
    if (weight <= 0.0) continue;
    nothing_to_shade = false;
    vec3 own = reflectedBy(f, frame, wo);
    if (nothing_to_shade) {
      invalid += weight;
    } else {
      radiance += weight * own;
    }
  } while (i++ < int(drawn_texels.z) - 1);
  return vec4(radiance / max(1.0 - invalid, 1e-6), 1.0 + invalid);
}

//? end
void main() {
  Footprints f = pixelFootprints();
//? if cast_shadow
  vec3 along_x = dFdx(world_position);  // before any pixel is discarded
  vec3 along_y = dFdy(world_position);
//? end
  mat3 frame = seenFrame(gl_FrontFacing, world_normal, world_tangent);  //? if double_sided
  mat3 frame = tangentFrame(world_normal, world_tangent);               //? else
  fetchNeighbourFrames(frame, f);  //? if screen_derivatives
  drawPoint();  //? if random_draws
  if (meanAlpha(f) < lobe_cutoff.y) discard;  //? if alpha_mask
  tangent_to_camera = world_to_camera * frame;  //? if surface_coordinates or screen_derivatives
  vec3 to_viewer = to_camera;                                    //? if orthographic
  vec3 to_viewer = normalize(camera_position - world_position);  //? else
  seen_facet = facetNormal(along_x, along_y, to_viewer);  //? if cast_shadow
//? if sampling_texel
  vec4 mean = meanOverTexels(f, frame, to_viewer * frame);
  vec3 radiance = mean.rgb;
  float coverage = mean.a;
//? else
  vec3 radiance = meanReflected(f, frame, to_viewer * frame);
//? if sampling_frame
  float coverage = 1.0;
//? else
  float coverage = nothing_to_shade ? 2.0 : 1.0;  // covered, without radiance: resolve_samples.glsl
  if (nothing_to_shade) radiance = vec3(0.0);
//? end
//? end
  radiance = vec3(meanTrips(probe_trips), meanTrips(lobe_trips), meanTrips(walk_trips));  //? if counting_trips
  radiance = vec3(lookups, lobe_evaluations, finest_area);                                //? elif counting
  radiance_coverage = vec4(radiance, share_uv_offset_set.w + coverage - 1.0);  //? if material_index
  radiance_coverage = vec4(radiance, coverage);                                //? else
}
