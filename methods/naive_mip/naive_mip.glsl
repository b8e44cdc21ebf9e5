// The mean normal, renormalised, with the mean roughness: one lobe, as wide as a facet's own.
struct Effective {
  Facets facets;
};

Effective effective(Footprints f) {
//? if normal_variation
  vec3 mean = fetch(naive_normal, f.normal).xyz;
//? if storage_unorm8
  mean = 2.0 * mean - 1.0;
//? end
  float size = length(mean);
  vec3 normal = size > 1e-6 ? mean / size : vec3(0.0, 0.0, 1.0);
//? else
  vec3 normal = vec3(0.0, 0.0, 1.0);
//? end
//? if roughness_variation
  float lobe = lobeFromRoughness(fetch(naive_roughness, f.roughness).r);
//? else
  float lobe = lobe_cutoff.x;
//? end
  return Effective(evenFacets(normal, lobe));
}

vec3 specular(Effective e, vec3 f0, vec3 wi, vec3 wo) { return facetSpecular(e.facets, f0, wi, wo); }

//? if diffuse
vec3 diffuse(Effective e, vec3 albedo, vec3 f0, vec3 wi, vec3 wo) {
  return lambert(e.facets.normal, albedo, f0, wi, wo);
}
//? end

float ndf(Effective e, vec3 h) { return facetDensity(e.facets, h); }

//? if environment_light
//? include facet_normal_lobes.glsl

vec3 meanNormal(Effective e) { return e.facets.normal; }
//? end
