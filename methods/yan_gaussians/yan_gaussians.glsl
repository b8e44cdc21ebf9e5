// Sums Gaussian elements, one per texel, under a Gaussian footprint. Supersampled images draw the facet of one texel.
#if NORMAL_VARIATION
// The footprint on the stored map, which appends the mirror image of a map that does not repeat.
Footprint folded(Footprint f) {
  vec2 share = yan_wrap[0];
  f.uv = mix(f.uv, clamp(f.uv, 0.0, 1.0), yan_wrap[1]) * share;
  f.dx *= share;
  f.dy *= share;
  return f;
}

#endif
// The reflectance of an element, from mean and covariance of its normals on the disc and the roughness of each.

// The value of each element: its reflectance without the Fresnel term, or its density of normals at h.
struct Query {
  bool reflects;
  vec3 h;
  vec3 wi;
  vec3 wo;
};

// The unit normal over a point of the disc, at least a hundredth above the horizon.
vec3 onSphere(vec2 disc) {
  float squared = dot(disc, disc);
  if (squared > 0.9999) return vec3(disc * sqrt(0.9999 / squared), 0.01);
  return vec3(disc, sqrt(1.0 - squared));
}

#if ROUGHNESS_INTRINSIC
const vec3 no_spread = vec3(0.0);

// A Gaussian on the disc (Yan 2016). Its covariance is that of the element's normals, (xx, xy, yy), plus sigma_r^2
// along both axes. Multiplied by h_z it is a density over solid angle. The determinant is a sum of non-negative parts.
float elementDensity(vec3 normal, vec3 spread, vec3 h) {
  countLobes(1);
  float rough = option_sigma_r * option_sigma_r;
  float both = spread.x + spread.z;
  float det = rough * rough + rough * both + max(spread.x * spread.z - spread.y * spread.y, 0.0);
  vec2 d = h.xy - normal.xy;
  float q = (spread.z + rough) * d.x * d.x - 2.0 * spread.y * d.x * d.y + (spread.x + rough) * d.y * d.y;
  return max(h.z, 0.0) * exp(-0.5 * q / det) / (2.0 * pi * sqrt(det));
}

float elementValue(vec3 normal, vec3 spread, Query q) {
  float density = elementDensity(normal, spread, q.h);
  if (!q.reflects || density <= 0.0) return density;
  return density * geometryFactor(lobeFromVariance(option_sigma_r * option_sigma_r), normal, q.h, q.wi, q.wo);
}

// The largest distance on the disc between h and a normal whose roughness reaches h.
float normalReach() { return option_cutoff * option_sigma_r; }
#else
const float no_spread = 0.0;

// The base lobe about the mean normal, widened in all directions by the mean of the element's variances on the sphere.
float elementValue(vec3 normal, float variance, Query q) {
  Facets facets = spreadFacets(normal, lobeVariance(yan_lobe), variance);
  return q.reflects ? facetReflectance(facets, q.h, q.wi, q.wo) : facetDensity(facets, q.h);
}

// The largest chord between h and the normal of a facet whose lobe has exp(-cutoff^2 / 2) of its peak at h.
float normalReach() {
  float most = 0.5 * option_cutoff * option_cutoff;
#if MULTI_LOBE || DISTRIBUTION_GGX
  return 4.0;  // no cut-off preserves the tail, and lobes may have any axis
#elif DISTRIBUTION_BLINN_PHONG
  return sqrt(2.0 * (1.0 - exp(-most / yan_lobe)));
#elif DISTRIBUTION_VMF
  return sqrt(min(2.0 * most / yan_lobe, 4.0));
#else
  // exp(-t / alpha^2) (1 + t)^2 with t the squared tangent: one step of the fixed point t = alpha^2 (most + 2 log(1 +
  // t)), from a start above the solution.
  float a2 = yan_lobe * yan_lobe;
  float t = a2 * (most + 2.0 * log(1.0 + a2 * (most + 8.0)));
  return sqrt(2.0 * (1.0 - inversesqrt(1.0 + t)));
#endif
}
#endif
#if NORMAL_VARIATION && SAMPLING_FRAME
#include "yan_sum.glsl"
#else
// The facet of one texel, for samples of a supersampled image and for surfaces without a normal map.
struct Effective {
  vec3 normal;
};

Effective effective(Footprints f) {
#if NORMAL_VARIATION
  return Effective(normalize(fetchFinest(mean_normal, folded(f.normal)).xyz));
#else
  return Effective(vec3(0.0, 0.0, 1.0));
#endif
}

float ndf(Effective e, vec3 h) { return elementValue(e.normal, no_spread, Query(false, h, h, h)); }

float reflectedDensity(Effective e, vec3 h, vec3 wi, vec3 wo) {
  return elementValue(e.normal, no_spread, Query(true, h, wi, wo));
}

vec3 meanNormal(Effective e) { return e.normal; }
#endif

#include "density_module.glsl"
