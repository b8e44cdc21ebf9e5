// A module with several parts of the normals per pixel, each with share, mean, covariance and a stretched base lobe.
// Includers define `const int parts`, `Part` and its functions (stretched_part.glsl), `effective`, and `partsSpecular`,
// for which even_parts.glsl is one choice.
#include "part_moments.glsl"

struct Effective {
  Part part[parts];
  vec3 mean_normal;  // not renormalised: its dot product is the mean of the texels' own
};

float ndf(Effective e, vec3 h) {
  Direction at = directionOf(h);
  float sum = 0.0;
  for (int i = 0; i < parts; ++i) sum += partDensity(e.part[i], at);
  return sum;
}

// The specular term of all parts about a half vector.
vec3 partsSpecular(Effective e, Surface s, vec3 h, vec3 wi, vec3 wo);

// The density of a part times its geometry factor, that of single facets about the mean of the part.
float partReflectance(Part part, Direction at, vec3 h, vec3 wi, vec3 wo) {
  return partDensity(part, at) * baseGeometry(part.lobe, part.axis, h, wi, wo);
}

Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo) {
  Reflected r;
  r.specular = vec3(0.0);
  if (halfVectorIsDefined(wi, wo)) r.specular = partsSpecular(e, s, halfVector(wi, wo), wi, wo);
#if DIFFUSE
  r.diffuse = diffuse(e.mean_normal, s, wi, wo);
#endif
  return r;
}

#if LOBES_LISTED
int lobeCount(Effective e) { return parts * lobes_per_part; }

NormalLobe normalLobe(Effective e, int i) { return partLobe(e.part[i / lobes_per_part], i % lobes_per_part); }

float lobeGeometry(Effective e, NormalLobe lobe, vec3 h, vec3 wi, vec3 wo) {
  return baseGeometry(lobe.base, lobe.normal, h, wi, wo);
}

vec3 meanNormal(Effective e) { return e.mean_normal; }
#endif
