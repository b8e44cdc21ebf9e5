// The forward pass: linear radiance towards the camera, and coverage in alpha, with everything that methods share.
in vec3 world_position;
in vec3 world_normal;
in vec4 world_tangent;
in vec2 uv0;
in vec2 uv1;
#if SURFACE_COORDINATES
in vec2 surface_uv;
#endif
#if VERTEX_COLOR
in vec4 vertex_color;
#endif

layout(location = 0) out vec4 radiance_coverage;

uniform vec3 camera_position;
#if SURFACE_COORDINATES || SCREEN_DERIVATIVES
uniform mat3 world_to_camera;
#endif
#if ORTHOGRAPHIC
uniform vec3 to_camera;
#endif
#if !SAMPLING_FRAME
bool nothing_to_shade = false;  // set by a module whose sample fell on an invalid texel
#endif

#include "method_module.glsl"
#include "method_contract.glsl"

Footprint footprintOf(vec4 linear, vec4 offset_set) {
  vec2 mapped = mat2(linear.xy, linear.zw) * (offset_set.z < 0.5 ? uv0 : uv1) + offset_set.xy;
  return Footprint(mapped, dFdx(mapped), dFdy(mapped));
}

Footprints pixelFootprints() {
  Footprints f;
  f.normal = footprintOf(uv_linear[0], uv_offset_set[0]);
#if SHARED_COORDINATES
  f.roughness = f.normal;
  f.base_color = f.normal;
#else
  f.roughness = footprintOf(uv_linear[1], uv_offset_set[1]);
  f.base_color = footprintOf(uv_linear[2], uv_offset_set[2]);
#endif
#if SPECULAR_VARIATION && SHARED_COORDINATES
  f.specular = f.normal;
#elif SPECULAR_VARIATION
  f.specular = footprintOf(specular_uv_linear, specular_uv_offset_set);
#endif
#if SURFACE_COORDINATES
  f.surface = Footprint(surface_uv, dFdx(surface_uv), dFdy(surface_uv));
#endif
#if NORMAL_LAYERS
  f.layer = footprintOf(uv_linear[3], uv_offset_set[3]);
#endif
#if CLEAR_COAT && COAT_WEIGHT_VARIATION
  f.coat_weight = footprintOf(coat_uv_linear[0], coat_uv_offset_set[0]);
#endif
#if CLEAR_COAT && COAT_WIDTH_VARIATION
  f.coat_width = footprintOf(coat_uv_linear[1], coat_uv_offset_set[1]);
#endif
#if CLEAR_COAT && COAT_NORMAL_VARIATION
  f.coat_normal = footprintOf(coat_uv_linear[2], coat_uv_offset_set[2]);
#endif
#if MATERIAL_INDEX
  f.share = footprintOf(share_uv_linear, share_uv_offset_set);
#endif
#if EMISSION_VARIATION
  f.emission = footprintOf(emission_uv_linear, emission_uv_offset_set);
#endif
#if OCCLUSION
  f.occlusion = footprintOf(occlusion_uv_linear, occlusion_uv_offset_set);
#endif
  return f;
}

#if RANDOM_DRAWS
#include "sample_draws.glsl"
#endif

#include "tangent_frame.glsl"

#if CAST_SHADOW
#include "facet_normal.glsl"
vec3 seen_facet;  // of the pixel

#endif
#include "incident_light.glsl"

#if SCREEN_DERIVATIVES
#include "neighbour_pixels.glsl"

#endif
#if FILTER_PARTS
#include "footprint_parts.glsl"
#endif

#if CLEAR_COAT
#include "clear_coat.glsl"

#endif
#if ANISOTROPIC_LOBE && ANISOTROPY_VARIATION
#include "stretch_under.glsl"
#endif
// The surface seen through a pixel or a part of it.
struct SurfacePoint {
  Effective effective;
  Surface surface;
  mat3 frame;
  vec3 wo;  // tangent frame
#if CLEAR_COAT
  Coat coat;
#endif
};

// f * cos of both terms, and the coat over them.
vec3 withCoat(SurfacePoint p, Reflected r, vec3 wi) {
#if DIFFUSE
  vec3 base = r.specular + r.diffuse;
#else
  vec3 base = r.specular;
#endif
#if CLEAR_COAT
  return (1.0 - p.coat.share) * base + coatReflectance(p.coat, wi, p.wo);
#else
  return base;
#endif
}

vec3 reflectance(SurfacePoint p, vec3 wi) { return withCoat(p, shade(p.effective, p.surface, wi, p.wo), wi); }

// The contribution of one light.
vec3 reflected(SurfacePoint p, Incident light) {
  if (!reachesFacets(light.wi)) return vec3(0.0);
#if SCREEN_DERIVATIVES
  Reflected r = shade(p.effective, p.surface, light.wi, p.wo, halfSteps(light.wi, light.source, p.wo));
#else
  Reflected r = shade(p.effective, p.surface, light.wi, p.wo);
#endif
  return withCoat(p, r, light.wi) * light.irradiance_at_normal;
}

#if DIRECTIONS_DRAWN && !ENVIRONMENT_DENSE || AREA_SAMPLED
#include "direction_draws.glsl"

#endif
#if ENVIRONMENT_SAMPLED
#include "environment_sampling.glsl"
#endif
#if ENVIRONMENT_LIGHT && !ENVIRONMENT_SAMPLED
#include "environment_stack.glsl"
#endif

#if AREA_SAMPLED
#include "area_sampling.glsl"

#endif
#if AREA_LOBES
#include "area_lobes.glsl"

#endif
#if FILTER_PARTS
// Evaluates every light once per pixel, independent of the number of parts.
Incident arriving[max(light_capacity, 1)];
int arriving_count = 0;

void add(Incident light) {
  if (reachesFacets(light.wi)) arriving[arriving_count++] = light;
}

void findLight(mat3 frame) {
#if POINT_LIGHT
  for (int i = 0; i < point_light_count; ++i) add(incidentPoint(i, frame));
#endif
#if SPOT_LIGHT
  for (int i = 0; i < spot_light_count; ++i) add(incidentSpot(i, frame));
#endif
#if DIRECTIONAL_LIGHT
  for (int i = 0; i < directional_light_count; ++i) add(incidentDirectional(i, frame));
#endif
#if AREA_POINTS
  for (int i = 0; i < area_point_count; ++i) add(incidentAreaPoint(i, frame));
#endif
}
#endif

#if ENVIRONMENT_LIGHT && !ENVIRONMENT_SAMPLED
// Environment light, by lobes.
vec3 environmentRadiance(SurfacePoint p) {
#if ENVIRONMENT_SUMMED
  vec3 base = environmentSum(p.effective, p.surface, p.wo, p.frame);
#else
  vec3 base = environmentLit(p.effective, p.surface, p.wo, p.frame);
#endif
#if CLEAR_COAT
  return (1.0 - p.coat.share) * base + coatLit(p);
#else
  return base;
#endif
}

#endif
#if OCCLUSION
float unoccluded;  // the share of the environment's light that the occlusion map leaves
#endif

vec3 lit(SurfacePoint p) {
  vec3 radiance = vec3(0.0);
#if FILTER_PARTS
  for (int i = 0; i < arriving_count; ++i) radiance += reflected(p, arriving[i]);
#else
#if POINT_LIGHT
  int point = 0;
  do {
    radiance += reflected(p, incidentPoint(point, p.frame));
  } while (point++ < point_light_count - 1);
#endif
#if SPOT_LIGHT
  int spot = 0;
  do {
    radiance += reflected(p, incidentSpot(spot, p.frame));
  } while (spot++ < spot_light_count - 1);
#endif
#if DIRECTIONAL_LIGHT
  int directional = 0;
  do {
    radiance += reflected(p, incidentDirectional(directional, p.frame));
  } while (directional++ < directional_light_count - 1);
#endif
#if AREA_POINTS
  int area_point = 0;
  do {
    radiance += reflected(p, incidentAreaPoint(area_point, p.frame));
  } while (area_point++ < area_point_count - 1);
#endif
#endif
#if AREA_SAMPLED
  radiance += areaIntegral(p);
#endif
#if AREA_LOBES
  radiance += areaLit(p);
#endif
#if ENVIRONMENT_SAMPLED && OCCLUSION
  radiance += unoccluded * environmentIntegral(p);
#elif ENVIRONMENT_SAMPLED
  radiance += environmentIntegral(p);
#elif ENVIRONMENT_LIGHT && OCCLUSION
  radiance += unoccluded * environmentRadiance(p);
#elif ENVIRONMENT_LIGHT
  radiance += environmentRadiance(p);
#endif
#if ENVIRONMENT_SUNS && OCCLUSION
  radiance += unoccluded * sunRadiance(p);
#elif ENVIRONMENT_SUNS
  radiance += sunRadiance(p);
#endif
  return radiance;
}

// Base colour = factor * map * vertex colour (glTF 2.0, sections 3.9.2 and 3.7.2.1).
vec4 baseColor(Footprints f) {
  vec4 color = base_color_factor;
#if BASE_COLOR_VARIATION
  color *= fetch(base_color_map, f.base_color);
#endif
#if VERTEX_COLOR
  color *= vertex_color;
#endif
  return color;
}

Surface surfaceUnder(Footprints f, vec3 base_color) {
  float metallic = dielectric_specular_metallic.w;
#if METALLIC_VARIATION
  metallic = fetch(metallic_map, f.roughness).r;
#endif
  vec3 dielectric_specular = dielectric_specular_metallic.rgb;
#if SPECULAR_VARIATION
  dielectric_specular *= fetch(specular_map, f.specular).rgb;
#endif
  return Surface(base_color * (1.0 - metallic), mix(dielectric_specular, base_color, metallic));
}

#if EMITTING
// The light that a surface emits through its coat (KHR_materials_clearcoat, Emission).
vec3 emission(Footprints f, SurfacePoint p) {
  vec3 radiance = emitted.rgb;
#if EMISSION_VARIATION
  radiance *= fetch(emission_map, f.emission).rgb;
#endif
#if CLEAR_COAT
  return (1.0 - p.coat.share) * radiance;
#else
  return radiance;
#endif
}
#endif

#if ALPHA_MASK
// The alpha test cuts out whole pixels, by the mean alpha over the pixel, which is never drawn at random.
float meanAlpha(Footprints f) {
#if FILTER_SHADED
  float sum = 0.0;
  int parts = probesHere(partCount());
  for (int i = 0; i < parts; ++i) sum += baseColor(partOf(f, i)).a;
  return sum / float(parts);
#else
  return baseColor(f).a;
#endif
}
#endif

// The radiance of a footprint, times the share of the material.
vec3 reflectedBy(Footprints f, mat3 frame, vec3 wo) {
#if MATERIAL_INDEX
  float share = fetch(material_share, f.share).r;
  if (share <= 0.0) return vec3(0.0);
#endif
#if UNLIT && EMITTING
  if (lobe_cutoff.z > 0.0) return vec3(0.0);
#elif UNLIT && MATERIAL_INDEX
  if (lobe_cutoff.z > 0.0) return share * baseColor(f).rgb;
#elif UNLIT
  if (lobe_cutoff.z > 0.0) return baseColor(f).rgb;
#endif
#if ANISOTROPIC_LOBE && ANISOTROPY_VARIATION
  stretch = stretchUnder(f);
#endif
#if CLEAR_COAT
  SurfacePoint p = SurfacePoint(effective(f), surfaceUnder(f, baseColor(f).rgb), frame, wo, coatUnder(f, wo));
#else
  SurfacePoint p = SurfacePoint(effective(f), surfaceUnder(f, baseColor(f).rgb), frame, wo);
#endif
#if OCCLUSION
  unoccluded = fetch(occlusion_map, f.occlusion).r;
#endif
  vec3 radiance = lit(p);
#if EMITTING
  radiance += emission(f, p);
#endif
#if MATERIAL_INDEX
  return share * radiance;
#else
  return radiance;
#endif
}

// The mean over the footprint of the pixel.
vec3 meanReflected(Footprints f, mat3 frame, vec3 wo) {
#if FILTER_PARTS
  findLight(frame);
  vec3 sum = vec3(0.0);
  int parts = probesHere(partCount());
  int i = 0;
  do {
    sum += reflectedBy(partOf(f, i), frame, wo);
  } while (++i < parts);
  return sum / float(parts);
#else
  return reflectedBy(f, frame, wo);
#endif
}

#if SAMPLING_TEXEL
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

#endif
void main() {
  Footprints f = pixelFootprints();
#if CAST_SHADOW
  vec3 along_x = dFdx(world_position);  // before any pixel is discarded
  vec3 along_y = dFdy(world_position);
#endif
#if DOUBLE_SIDED
  mat3 frame = seenFrame(gl_FrontFacing, world_normal, world_tangent);
#else
  mat3 frame = tangentFrame(world_normal, world_tangent);
#endif
#if SCREEN_DERIVATIVES
  fetchNeighbourFrames(frame, f);
#endif
#if RANDOM_DRAWS
  drawPoint();
#endif
#if ALPHA_MASK
  if (meanAlpha(f) < lobe_cutoff.y) discard;
#endif
#if SURFACE_COORDINATES || SCREEN_DERIVATIVES
  tangent_to_camera = world_to_camera * frame;
#endif
#if ORTHOGRAPHIC
  vec3 to_viewer = to_camera;
#else
  vec3 to_viewer = normalize(camera_position - world_position);
#endif
#if CAST_SHADOW
  seen_facet = facetNormal(along_x, along_y, to_viewer);
#endif
#if SAMPLING_TEXEL
  vec4 mean = meanOverTexels(f, frame, to_viewer * frame);
  vec3 radiance = mean.rgb;
  float coverage = mean.a;
#else
  vec3 radiance = meanReflected(f, frame, to_viewer * frame);
#if SAMPLING_FRAME
  float coverage = 1.0;
#else
  float coverage = nothing_to_shade ? 2.0 : 1.0;  // covered, without radiance: resolve_samples.glsl
  if (nothing_to_shade) radiance = vec3(0.0);
#endif
#endif
#if COUNTING_TRIPS
  radiance = vec3(meanTrips(probe_trips), meanTrips(lobe_trips), meanTrips(walk_trips));
#elif COUNTING
  radiance = vec3(lookups, lobe_evaluations, finest_area);
#endif
#if MATERIAL_INDEX
  radiance_coverage = vec4(radiance, share_uv_offset_set.w + coverage - 1.0);
#else
  radiance_coverage = vec4(radiance, coverage);
#endif
}
