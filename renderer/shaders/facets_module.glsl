// A module with one set of facets about one normal per pixel; includers define `effective`.
struct Effective {
  Facets facets;
};

Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo) { return facetShade(e.facets, s, wi, wo); }

float ndf(Effective e, vec3 h) { return facetDensity(e.facets, h); }

#if LOBES_LISTED
#include "facet_normal_lobes.glsl"

vec3 meanNormal(Effective e) { return e.facets.normal; }
#endif
