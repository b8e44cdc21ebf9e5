// Facets whose lobe is wider along one direction of their tangent plane. The direction turns with the facet's normal, by
// the shortest rotation from the surface's (docs/explanation/base-brdf.md).

#include "anisotropic_widths.glsl"

// Alpha along and across the direction, of the base lobe whose round mean has the parameter `lobe`; and that direction.
#if ANISOTROPY_VARIATION
// The stretch of what is shaded: (along^2 - across^2) / (along^2 + across^2) times the direction's cosine and sine of
// twice its angle (stretch_of in renderer/lobes/lobe.hpp). Whoever calls `effective` sets it first.
vec2 stretch = vec2(0.0);
vec2 facetAlphas(float lobe) {
  float r = min(length(stretch), 1.0);
  return max(lobe * sqrt(vec2(1.0 + r, 1.0 - r)), smallest_alpha);
}
vec2 facetDirection() {
  float r = length(stretch);
  if (r < 1e-12) return vec2(1.0, 0.0);
  return normalize(stretch.x >= 0.0 ? vec2(r + stretch.x, stretch.y) : vec2(stretch.y, r - stretch.x));
}
#else
vec2 facetDirection() { return anisotropy().zw; }
#if ROUGHNESS_VARIATION
// With q the squared strength and p = 1 - q, along = q + p across, and along^2 + across^2 = 2 lobe^2.
vec2 facetAlphas(float lobe) {
  float q = lobe_cutoff.w;
  float p = 1.0 - q;
  float norm = 1.0 + p * p;
  float across = max((sqrt(max(2.0 * norm * lobe * lobe - q * q, 0.0)) - p * q) / norm, smallest_alpha);
  return vec2(q + p * across, across);
}
#else
vec2 facetAlphas(float lobe) { return anisotropy().xy; }
#endif
#endif

// The symmetric matrix with `along` and `across` in the axes of the direction.
mat2 inFacetAxes(float along, float across) { return inAxes(along, across, facetDirection()); }

// w^T A w of a direction's tangential part w in the facet's frame is (alpha sin)^2, alpha the lobe's towards w.
mat2 squaredWidths(float lobe) {
  vec2 alphas = facetAlphas(lobe);
  return inFacetAxes(alphas.x * alphas.x, alphas.y * alphas.y);
}

float baseDensity(float lobe, vec3 n, vec3 h) { return stretchedDensity(facetAlphas(lobe), facetDirection(), n, h); }

float baseGeometry(float lobe, vec3 n, vec3 h, vec3 wi, vec3 wo) {
  return stretchedGeometry(squaredWidths(lobe), lobe, n, h, wi, wo);
}
