// A module whose pixel is one set of facets about one normal: all but `effective`.
struct Effective {
  Facets facets;
};

vec3 specular(Effective e, vec3 f0, vec3 wi, vec3 wo) { return facetSpecular(e.facets, f0, wi, wo); }

//? if diffuse
vec3 diffuse(Effective e, vec3 albedo, vec3 f0, vec3 wi, vec3 wo) {
  return lambert(e.facets.normal, albedo, f0, wi, wo);
}
//? end

float ndf(Effective e, vec3 h) { return facetDensity(e.facets, h); }
