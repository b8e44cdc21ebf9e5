// The geometry of one sample for the mask of interior pixels: piece of surface, position and orientation. With
// `cast_shadow`, the share of four lights that reaches it instead.
in vec3 world_position;
in vec3 world_normal;
in vec2 uv0;
in vec2 uv1;
flat in vec2 piece;  // numbers of chart and material
#if ALPHA_MASK && VERTEX_COLOR
in float vertex_alpha;
#endif

#if CAST_SHADOW
layout(location = 0) out vec4 light_shares;
uniform int first_light;  // of the four, points before spots before directions before areas
#else
layout(location = 0) out vec4 position_chart;   // world space; 0: nothing is there
layout(location = 1) out vec4 facet_material;  // the triangle's own normal, towards the viewer
layout(location = 2) out vec4 normal_extent;    // the vertices' normal; what the pixel spans on the surface, metres
layout(location = 3) out vec4 mapped_stretch;   // uv, their gradient's length in 1/m, the footprint's longer edge in texels
layout(location = 4) out float material_alone;  // number of the only material that the pixel shows; 0: several, or back
uniform float grid;      // samples along a pixel's edge
uniform vec2 map_size;   // of the normal map, texels; 0: there is none
uniform vec2 to_centre;  // from the pixel's first sample to its centre, in samples
#endif
#if ORTHOGRAPHIC
uniform vec3 to_camera;
#else
uniform vec3 camera_position;
#endif

const float least_alone = 0.99;  // share of a pixel from which one material counts as alone

#include "facet_normal.glsl"
#if ALPHA_MASK
#include "alpha_mask.glsl"
#endif

#if CAST_SHADOW
// If the horizon cuts light off, light from below the surface does not reach it (docs/explanation/base-brdf.md).
void addShare(inout vec4 shares, int place, float first_view, vec3 facet, vec3 normal, vec3 to_light) {
  if (place < 0 || place > 3) return;
#if !HORIZON_OPEN
  if (dot(normal, to_light) <= 0.0) return;
#endif
  shares[place] = clearOfShadow(first_view, world_position, facet, -to_light);
}

vec4 lightShares(vec3 facet, vec3 normal) {
  vec4 shares = vec4(0.0);
  int place = -first_light;
#if POINT_LIGHT
  for (int i = 0; i < point_light_count; ++i)
    addShare(shares, place++, point_lights[i].intensity.w, facet, normal, point_lights[i].position_range.xyz - world_position);
#endif
#if SPOT_LIGHT
  for (int i = 0; i < spot_light_count; ++i)
    addShare(shares, place++, spot_lights[i].intensity.w, facet, normal, spot_lights[i].position_range.xyz - world_position);
#endif
#if DIRECTIONAL_LIGHT
  for (int i = 0; i < directional_light_count; ++i)
    addShare(shares, place++, directional_lights[i].illuminance.w, facet, normal, directional_lights[i].to_light.xyz);
#endif
#if AREA_LIGHT
  for (int i = 0; i < area_light_count; ++i)
    addShare(shares, place++, area_lights[i].intensity.w, facet, normal, area_lights[i].position_area.xyz - world_position);
#endif
  return shares;
}
#endif

#if MATERIAL_INDEX && !CAST_SHADOW
// Whether the pixel around a sample shows none of the other materials of its surface.
bool isAlone() {
  vec2 uv = share_uv_offset_set.z < 0.5 ? uv0 : uv1;
  vec2 mapped = mat2(share_uv_linear.xy, share_uv_linear.zw) * uv + share_uv_offset_set.xy;
  vec2 mapped_x = dFdx(mapped), mapped_y = dFdy(mapped);
  vec2 centre = mapped + to_centre.x * mapped_x + to_centre.y * mapped_y;
  return textureGrad(material_share, centre, grid * mapped_x, grid * mapped_y).r > least_alone;
}
#endif

void main() {
  vec3 along_x = dFdx(world_position);  // before any pixel is discarded
  vec3 along_y = dFdy(world_position);
#if !CAST_SHADOW
  vec2 mapped = mat2(uv_linear[0].xy, uv_linear[0].zw) * (uv_offset_set[0].z < 0.5 ? uv0 : uv1) + uv_offset_set[0].xy;
  vec2 mapped_x = dFdx(mapped);
  vec2 mapped_y = dFdy(mapped);
#if MATERIAL_INDEX
  bool is_alone = isAlone();
  // Further materials of a surface only write their index where the first one left 0.
  if (share_uv_offset_set.w < 0.5 && !is_alone) discard;
#else
  const bool is_alone = true;
#endif
#endif
#if ALPHA_MASK
  if (isCutOut()) discard;
#endif
#if ORTHOGRAPHIC
  vec3 to_viewer = to_camera;
#else
  vec3 to_viewer = normalize(camera_position - world_position);
#endif
  vec3 facet = facetNormal(along_x, along_y, to_viewer);
  vec3 normal = normalize(gl_FrontFacing ? world_normal : -world_normal);
#if CAST_SHADOW
  light_shares = lightShares(facet, normal);
#else
  // The gradient of texture coordinates over the plane of the triangle: u changes by dot(gradient, step) over a step.
  vec3 across_x = cross(along_y, facet), across_y = cross(facet, along_x);
  float area = max(abs(dot(along_x, across_x)), 1e-37);
  vec3 gradient_u = (mapped_x.x * across_x + mapped_y.x * across_y) / area;
  vec3 gradient_v = (mapped_x.y * across_x + mapped_y.y * across_y) / area;
  position_chart = vec4(world_position, piece.x);
  facet_material = vec4(facet, piece.y);
  normal_extent = vec4(normal, grid * (length(along_x) + length(along_y)));
  mapped_stretch = vec4(mapped, length(vec2(length(gradient_u), length(gradient_v))),
                        grid * max(length(mapped_x * map_size), length(mapped_y * map_size)));
  material_alone = is_alone && dot(normal, to_viewer) > 0.0 ? piece.y : 0.0;
#endif
}
