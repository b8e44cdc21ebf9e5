// Density and geometry term of lobes that are wider along one direction of a facet's tangent plane.
#include "facet_frame.glsl"

// From the frame of a facet to the axes along and across a direction.
vec2 alongDirection(vec2 own, vec2 d) { return vec2(dot(d, own), d.x * own.y - d.y * own.x); }

// The symmetric matrix with `along` and `across` in those axes.
mat2 inAxes(float along, float across, vec2 d) { return mat2(across) + (along - across) * outerProduct(d, d); }

// Density over solid angle (Heitz 2014, section 5).
float stretchedDensity(vec2 alphas, vec2 direction, vec3 n, vec3 h) {
  countLobes(1);
  vec3 own = inFacetFrame(h, n);
  vec2 stretched = alongDirection(own.xy, direction) / alphas;
#if DISTRIBUTION_GGX
  if (own.z <= 0.0) return 0.0;
  float d = dot(stretched, stretched) + own.z * own.z;
  return 1.0 / (pi * alphas.x * alphas.y * d * d);
#else
  if (own.z <= 1e-3) return 0.0;  // tan overflows, and the exponential has long been zero
  float c2 = own.z * own.z;
  return exp(-dot(stretched, stretched) / c2) / (pi * alphas.x * alphas.y * c2 * c2);
#endif
}

// The geometry factor of facets about n. Smith's uses the width of the lobe towards each direction (Heitz 2014, section
// 5); the other terms do not depend on it.
#if MASKING_SHADOWING && GEOMETRY_SMITH
float stretchedGeometry(mat2 widths, float lobe, vec3 n, vec3 h, vec3 wi, vec3 wo) {
  float nl = dot(n, wi);
  if (nl <= 0.0) return 0.0;
  float nv = max(dot(n, wo), 1e-4);
  vec2 to_light = inFacetFrame(wi, n).xy;
  vec2 to_viewer = inFacetFrame(wo, n).xy;
  float light = max(dot(to_light, widths * to_light), 1e-12);
  float viewer = max(dot(to_viewer, widths * to_viewer), 1e-12);
#if DISTRIBUTION_GGX
  float masked = nl * sqrt(viewer + nv * nv) + nv * sqrt(light + nl * nl);
  return 0.5 * nl / max(masked, 1e-12);
#else
  return 0.25 / ((1.0 + beckmannLambda(nv * inversesqrt(viewer)) + beckmannLambda(nl * inversesqrt(light))) * nv);
#endif
}
#else
float stretchedGeometry(mat2 widths, float lobe, vec3 n, vec3 h, vec3 wi, vec3 wo) {
  return geometryFactor(lobe, n, h, wi, wo);
}
#endif
