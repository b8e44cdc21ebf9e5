// The mean normal, renormalised, with the mean roughness or the mean lobe parameter: one lobe, as wide as a facet's own.
//? include mean_normal.glsl
//? include facets_module.glsl

Effective effective(Footprints f) {
//? if roughness_variation
//? if averages_lobe
  float lobe = fetch(naive_lobe, f.roughness).r;
//? else
  float lobe = lobeFromRoughness(fetch(naive_roughness, f.roughness).r);
//? end
//? else
  float lobe = lobe_cutoff.x;
//? end
  return Effective(evenFacets(meanNormal(f).xyz, lobe));
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
