// First pass of the frame build: joins the base BRDF and the normal map into one lobe per texel (Xu 2017, section 4),
// or one for each lobe of the facets. Writes (r, 1), or 0 where there is no valid normal, no surface, or only one that
// faces away. Means of texels are (w r, w), with w the covered share of the footprint and r the mean of its lobes.
#include "xu_vmf_conversion.glsl"
#include "xu_vmf_storing.glsl"

layout(location = 0) out vec4 joined;
#if GUARD
layout(location = 1) out vec4 guard;  // 1 - |r|, unaffected by the rounding of r
#endif

#if NORMAL_VARIATION
layout(binding = 0) uniform sampler2D normals;  // weight in w: 0 if invalid
#endif
#if ROUGHNESS_VARIATION
layout(binding = 1) uniform sampler2D variances;  // of the base lobe's slopes
#endif
#if !CONVERSION_NEWTON
layout(binding = 2) uniform sampler2D shortfalls;
#endif
#if SPECULAR_JOINT && SPECULAR_VARIATION
layout(binding = 3) uniform sampler2D colours;  // luminance of the specular colour, over the largest
#endif

#if CAMERA
in vec3 world_position;
in vec3 world_normal;
in vec4 world_tangent;
in vec2 uv0;
in vec2 uv1;
uniform mat3 world_to_camera;
uniform vec4 viewer;  // (position, 1), or (direction to the viewer, 0)
uniform bool two_sided;

#include "tangent_frame.glsl"

// Whether the viewer sees the triangle's front, by the change of position over the texture, which may mirror it.
bool facesViewer() {
  vec3 outward = cross(dFdx(world_position), dFdy(world_position)) * (gl_FrontFacing ? 1.0 : -1.0);
  return dot(outward, viewer.xyz - viewer.w * world_position) > 0.0;
}

vec4 texelAt(sampler2D map, vec4 linear, vec4 offset_set) {
  vec2 uv = offset_set.z < 0.5 ? uv0 : uv1;
  return textureLod(map, mat2(linear.xy, linear.zw) * uv + offset_set.xy, 0.0);
}
vec4 texelOf(sampler2D map, int slot) { return texelAt(map, uv_linear[slot], uv_offset_set[slot]); }
#if SPECULAR_JOINT && SPECULAR_VARIATION
float weightOf(sampler2D map) { return texelAt(map, specular_uv_linear, specular_uv_offset_set).r; }
#endif
#else
uniform ivec2 map_size;

// The texel of another map under this one; maps of different sizes share their area.
vec4 texelOf(sampler2D map, int slot) {
  return texelFetch(map, ivec2(gl_FragCoord.xy) * textureSize(map, 0) / map_size, 0);
}
float weightOf(sampler2D map) { return texelOf(map, 0).r; }
#endif

#if MULTI_LOBE
uniform int own_lobe;  // of a facet; -1: only its normal
#endif

float shortfall(float kappa) {
#if CONVERSION_NEWTON
  return shortfallOf(kappa);
#else
  return tabulatedShortfall(shortfalls, kappa);
#endif
}

void main() {
  joined = vec4(0.0);
#if GUARD
  guard = vec4(0.0);
#endif
  vec4 normal = vec4(0.0, 0.0, 1.0, 1.0);
#if NORMAL_VARIATION
  normal = texelOf(normals, 0);
#endif
  float lobe = lobe_cutoff.x;
#if ROUGHNESS_VARIATION
  lobe = lobeFromVariance(texelOf(variances, 1).r);
#endif
  float size = length(normal.xyz);  // decoded bytes are up to 0.6% too long or short
  if (normal.w < 0.5 || size < 1e-3) return;
  vec3 axis = normal.xyz / size;
  float q = shortfall(kappaOfLobe(lobe));
#if MULTI_LOBE
  if (own_lobe < 0) {
    q = 0.0;
  } else if (facet_lobe_count > 0) {
    axis = turnedWithNormal(facet_lobes[own_lobe].axis, axis);
    q = shortfall(kappaOfLobe(facet_lobes[own_lobe].parameter));
  }
#endif
#if CAMERA
  bool front = facesViewer();
  if (!front && !two_sided) return;
  axis = seenFrame(front, world_normal, world_tangent) * axis;
#if CULLING_NORMALS
  if (dot(axis, viewer.xyz - viewer.w * world_position) <= 0.0) return;
#endif
  axis = world_to_camera * axis;
#endif
  float weight = 1.0;
#if SPECULAR_JOINT && SPECULAR_VARIATION
  weight = weightOf(colours);
#endif
  joined = stored(weight * vec4((1.0 - q) * axis, 1.0));
#if GUARD
  guard = stored(weight * vec4(q, 0.0, 0.0, 1.0));
#endif
}
