// Geometry is filtered, reflectance is not: the renormalised mean normal with the lobe of the texel at the pixel's
// centre (Tan 2005, figure 8d).
//? include mean_normal.glsl
//? include facets_module.glsl

Effective effective(Footprints f) {
//? if roughness_variation
  float lobe = lobeFromRoughness(fetchFinest(fixed_roughness, f.roughness).r);
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
