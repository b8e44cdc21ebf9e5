// The clear coat over what a point reflects (KHR_materials_clearcoat; docs/explanation/base-brdf.md, Clear coat): one filter for
// every method that filters. The reference, and a method that filters nothing, read the finest level.
#include "ggx_density.glsl"
#include "ggx_geometry.glsl"
#include "length_shortfall.glsl"

struct Coat {
  vec3 normal;  // unit, tangent frame
  float alpha2;
  float weight;
  float share;   // of what is seen: weight times Fresnel's term, of which the rest is the base's
  float spread;  // the part of alpha2 that is the normals' own variance
};

// Schlick's term for an index of refraction of 1.5 about the coat's normal. The extension uses the normal, not the half
// vector, so that the attenuation of the base is the same for all light.
float coatFresnel(float cosine) {
  float x = 1.0 - min(abs(cosine), 1.0);
  float x2 = x * x;
  return 0.04 + 0.96 * (x2 * x2 * x);
}

// The coat for a mean normal.
Coat coatOf(vec3 mean, float alpha2, float weight, vec3 wo) {
  float size = max(length(mean), 1e-3);
  vec3 normal = dot(mean, mean) > 1e-6 ? mean / size : vec3(0.0, 0.0, 1.0);  // some that cancel have no mean
  float spread = 0.0;
#if SAMPLING_FRAME && !FINEST_MAPS
  // Slope variance per axis, (1 - r) / r (Toksvig 2005), plus GGX's alpha^2 / 2.
  float added = 2.0 * shortfallOfLength(size, rounding_of_floats) / size;
  spread = added / (alpha2 + added);
  alpha2 = min(alpha2 + added, 1.0);
#endif
  return Coat(normal, alpha2, weight, weight * coatFresnel(dot(normal, wo)), spread);
}

#if FINEST_MAPS
vec4 fetchCoat(sampler2D map, Footprint f) { return fetchFinest(map, f); }
#else
vec4 fetchCoat(sampler2D map, Footprint f) { return fetch(map, f); }
#endif

Coat coatUnder(Footprints f, vec3 wo) {
#if COAT_WEIGHT_VARIATION
  float weight = fetchCoat(coat_weight_map, f.coat_weight).r;
#else
  float weight = coat_weight_width.x;
#endif
#if COAT_WIDTH_VARIATION
  float alpha2 = fetchCoat(coat_width_map, f.coat_width).r;
#else
  float alpha2 = coat_weight_width.y;
#endif
#if COAT_NORMAL_VARIATION
  return coatOf(fetchCoat(coat_normal_map, f.coat_normal).xyz, alpha2, weight, wo);
#else
  return coatOf(vec3(0.0, 0.0, 1.0), alpha2, weight, wo);
#endif
}

// The weight times the Fresnel term of the normals that reflect along h. For Gaussian slopes with a lobe each, the mean
// of these normals is between the mean normal and h, in proportion to their share of the total spread. At grazing
// views, where few normals reflect, this is much smaller than the term of the mean normal.
float coatShare(Coat coat, vec3 h, vec3 wo) {
#if COAT_NORMAL_VARIATION && SAMPLING_FRAME && !FINEST_MAPS
  return coat.weight * coatFresnel(dot(normalize(mix(coat.normal, h, coat.spread)), wo));
#else
  return coat.share;
#endif
}

// f * cos of the coat, times its share.
float coatReflectance(Coat coat, vec3 wi, vec3 wo) {
  if (coat.share <= 0.0 || !halfVectorIsDefined(wi, wo)) return 0.0;
  countLobes(1);
  vec3 h = halfVector(wi, wo);
  if (dot(coat.normal, h) <= 0.0) return 0.0;  // and no mean of the two where they are opposite
  return coatShare(coat, h, wo) * ggxDensity(coat.alpha2, coat.normal, h) *
         ggxGeometry(coat.alpha2, coat.normal, wi, wo);
}
