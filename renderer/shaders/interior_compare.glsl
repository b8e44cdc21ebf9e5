// Tests whether all samples of a pixel see one smooth piece of surface: each is compared with the first, at the lower
// left of the first pass. Blending takes the minimum over all passes: 1 if all agree.
#if CAST_SHADOW
layout(binding = 0) uniform sampler2D shares;
layout(binding = 4) uniform sampler2D first_shares;
#else
layout(binding = 0) uniform sampler2D positions;
layout(binding = 1) uniform sampler2D facets;
layout(binding = 2) uniform sampler2D normals;
layout(binding = 3) uniform sampler2D mapped;
layout(binding = 4) uniform sampler2D first_positions;
layout(binding = 5) uniform sampler2D first_facets;
layout(binding = 6) uniform sampler2D first_normals;
layout(binding = 7) uniform sampler2D first_mapped;
layout(binding = 8) uniform sampler2D first_material;
uniform bool by_coverage, by_material, by_chart, by_cut, by_normal, by_depth;
uniform float rounding;  // of positions, metres
#endif
uniform int grid;

// Interior (1 or 0); index of the only material in the pixel; unused; longer edge of the footprint in texels.
layout(location = 0) out vec4 smooth_material_texels;

// Half of the allowed differences of normals and of directions within the surface (interior.hpp).
const float least_cosine = 0.98480775;  // of 10 degrees
const float most_sine = 0.17364818;
const float most_share = 1.0 / 16.0;     // of a light
const float unbounded = 3e38;            // leaves what other passes wrote

#if CAST_SHADOW
bool agrees(ivec2 at, ivec2 first) {
  vec4 difference = abs(texelFetch(shares, at, 0) - texelFetch(first_shares, first, 0));
  return all(lessThanEqual(difference, vec4(most_share)));
}
#else
// The step from the first sample is within the surface: within 10 degrees of the plane of the triangle, and at most
// twice the span of the pixel there. At grazing views, a step to another sheet is almost in the plane.
bool isOnSurface(vec3 step, vec3 facet, float extent) {
  float size = length(step);
  return abs(dot(step, facet)) <= most_sine * size + rounding && size <= 2.0 * extent + rounding;
}

// Texture coordinates change at most twice as fast as over the plane of the triangle; wrapping is not a jump.
bool isWithoutJump(vec2 change, float stretch, float size) {
  vec2 repeated = change - round(change);
  return min(length(change), length(repeated)) <= 2.0 * stretch * size + 1e-4;
}

bool agrees(ivec2 at, ivec2 first) {
  vec4 p = texelFetch(positions, at, 0), p0 = texelFetch(first_positions, first, 0);
  vec4 f = texelFetch(facets, at, 0), f0 = texelFetch(first_facets, first, 0);
  vec4 n = texelFetch(normals, at, 0), n0 = texelFetch(first_normals, first, 0);
  vec4 m = texelFetch(mapped, at, 0), m0 = texelFetch(first_mapped, first, 0);
  if (p.w == 0.0 || p0.w == 0.0) return !by_coverage;
  vec3 step = p.xyz - p0.xyz;
  bool yes = true;
  if (by_material) yes = yes && f.w == f0.w;
  if (by_chart) yes = yes && p.w == p0.w;
  if (by_cut) yes = yes && isWithoutJump(m.xy - m0.xy, max(m.z, m0.z), length(step) + rounding);
  if (by_normal) yes = yes && dot(f.xyz, f0.xyz) >= least_cosine && dot(n.xyz, n0.xyz) >= least_cosine;
  if (by_depth) yes = yes && isOnSurface(step, f0.xyz, n0.w);
  return yes;
}
#endif

void main() {
  ivec2 corner = ivec2(gl_FragCoord.xy) * grid;
  bool all_agree = true;
  for (int y = 0; y < grid; ++y) {
    for (int x = 0; x < grid; ++x) all_agree = all_agree && agrees(corner + ivec2(x, y), corner);
  }
#if CAST_SHADOW
  smooth_material_texels = vec4(all_agree ? 1.0 : 0.0, vec3(unbounded));
#else
  smooth_material_texels = vec4(all_agree ? 1.0 : 0.0, texelFetch(first_material, corner, 0).r, 0.0,
                                texelFetch(first_mapped, corner, 0).w);
#endif
}
