// The base BRDF of a texel. The reference averages it over its samples.
#if NORMAL_LAYERS
#include "normal_layers.glsl"
#endif
#if MICROGEOMETRY_VISIBILITY
#include "patch_facets.glsl"
#else
#include "facets_module.glsl"
#endif

Effective effective(Footprints f) {
#if NORMAL_VARIATION
  vec4 texel = fetchFinest(base_normal, f.normal);
#if !SAMPLING_FRAME && MICROGEOMETRY_VISIBILITY
  nothing_to_shade = texel.w < 0.5 && base_has_patch < 0.5;
#elif !SAMPLING_FRAME
  nothing_to_shade = texel.w < 0.5;  // an invalid normal of the map: the surface is there, what it reflects is not known
#endif
  vec3 normal = normalize(texel.xyz);
#else
  vec3 normal = vec3(0.0, 0.0, 1.0);
#endif
#if NORMAL_LAYERS
  vec4 layer = fetchFinest(base_layer, f.layer);
#if !SAMPLING_FRAME
  if (layer.w < 0.5) nothing_to_shade = true;
#endif
  normal = withSlopesAdded(normal, layer.xyz);
#endif
#if ROUGHNESS_VARIATION
  float lobe = lobeFromRoughness(fetchFinest(base_roughness, f.roughness).r);
#else
  float lobe = lobe_cutoff.x;
#endif
#if MICROGEOMETRY_VISIBILITY
  return Effective(evenFacets(normal, lobe), drawnFacets());
#else
  return Effective(evenFacets(normal, lobe));
#endif
}

#if DIRECTIONS_DRAWN
#include "lobe_sampling.glsl"

// A direction about n with cosine density.
vec3 lambertDirection(vec3 n, vec2 u) {
  float azimuth = 2.0 * pi * u.y;
  return frameAbout(n) * vec3(sqrt(u.x) * vec2(cos(azimuth), sin(azimuth)), sqrt(1.0 - u.x));
}

// Draws a direction to the light: the mirror image of wo about a normal drawn from the facets. With a diffuse term,
// half of the draws use the cosine density instead. Zero if there is none.
vec3 drawDirection(Effective e, vec3 wo, vec3 u) {
#if MICROGEOMETRY_VISIBILITY
  if (base_has_patch > 0.5) return lambertDirection(vec3(0.0, 0.0, 1.0), u.xy);  // facets point everywhere
#endif
#if DIFFUSE
  if (u.z < 0.5) return lambertDirection(e.facets.normal, u.xy);
  u.z = 2.0 * u.z - 1.0;
#endif
  vec3 h = drawnFacet(e.facets, u);
  float cosine = dot(h, wo);
  return cosine > 0.0 ? 2.0 * cosine * h - wo : vec3(0.0);
}

// The density of that direction over solid angle.
float directionDensity(Effective e, vec3 wi, vec3 wo) {
#if MICROGEOMETRY_VISIBILITY
  if (base_has_patch > 0.5) return max(wi.z, 0.0) / pi;
#endif
  if (!halfVectorIsDefined(wi, wo)) return 0.0;
  vec3 h = halfVector(wi, wo);
  float density = drawnFacetDensity(e.facets, h) / (4.0 * max(dot(h, wo), 1e-6));
#if DIFFUSE
  density = 0.5 * density + 0.5 * max(dot(e.facets.normal, wi), 0.0) / pi;
#endif
  return density;
}
#endif
