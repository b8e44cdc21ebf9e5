// One lobe about the mean normal, as wide as a facet's own and the expected spread together. Slope variances of
// independent spreads add.
struct Effective {
  Facets facets;
};

Effective effective(Footprints f) {
//? if normal_variation
  vec4 texel = fetch(template_normal, f.normal);  // mean normal, spread
  float size = length(texel.xyz);
  vec3 normal = size > 1e-6 ? texel.xyz / size : vec3(0.0, 0.0, 1.0);
  return Effective(spreadFacets(normal, lobeVariance(template_lobe), option_share * texel.w));
//? else
  return Effective(evenFacets(vec3(0.0, 0.0, 1.0), template_lobe));
//? end
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
