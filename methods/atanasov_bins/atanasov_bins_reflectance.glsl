// What normals stand for, a texel's own or those of a bin together: a density at h, and what it reflects.

struct Query {
  bool reflects;  // f * cos but for the Fresnel term, else the density alone
  vec3 h;
  vec3 wi;
  vec3 wo;
  uint bin;       // of h
};

Query queryFor(bool reflects, vec3 h, vec3 wi, vec3 wo) { return Query(reflects, h, wi, wo, binIn(cellOf(h))); }

float binSolidAngle() { return 2.0 * pi / (bins_across * bins_across); }

//? if roughness_flakes
// Beckmann's density about a flake's normal, over solid angle (Walter 2007, equation 25).
float flakeDensity(float alpha, vec3 n, vec3 h) {
  countLobes(1);
  float c = dot(n, h);
  if (c <= 1e-3) return 0.0;
  vec3 s = cross(n, h);
  float c2 = c * c;
  float a2 = alpha * alpha;
  return exp(-dot(s, s) / (c2 * a2)) / (pi * a2 * c2 * c2);
}

float baseVariance(Footprints f) { return 0.5 * option_alpha * option_alpha; }

// Of normals with a slope variance per axis of `spread` about one.
float valueAbout(float variance, vec3 normal, float spread, Query q) {
  float alpha = sqrt(2.0 * (variance + spread));
  float density = flakeDensity(alpha, normal, q.h);
//? if surface_facets
  if (q.reflects) density *= geometryFactor(lobeFromAlpha(alpha), normal, q.h, q.wi, q.wo);
//? end
  return density;
}
//? elif roughness_bin and surface_facets
float baseVariance(Footprints f) { return binSolidAngle() / 12.0; }  // a square of area |H| along an axis
//? elif roughness_lobe
float valueAbout(float variance, vec3 normal, float spread, Query q) {
  Facets facets = spreadFacets(normal, variance, spread);
//? if surface_facets
  if (q.reflects) return facetReflectance(facets, q.h, q.wi, q.wo);
//? end
  return facetDensity(facets, q.h);
}
//? end

// What is the same for all normals: `value` is their mean density or, of facets with lobes, reflectance.
float finishedValue(float variance, float value, Query q) {
  if (!q.reflects || value == 0.0) return value;
//? if surface_microfacets
  // Walter 2007: D cos integrates to one over a surface about its own normal, D over solid angle does here.
  vec3 up = vec3(0.0, 0.0, 1.0);
  return value / max(q.h.z, 1e-3) * geometryFactor(lobeFromVariance(variance), up, q.h, q.wi, q.wo);
//? elif roughness_bin
  // Mirrors that face h, spread over their bin.
  return value * geometryFactor(lobeFromVariance(variance), q.h, q.h, q.wi, q.wo);
//? else
  return value;
//? end
}
