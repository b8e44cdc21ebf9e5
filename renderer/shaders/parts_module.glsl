// A module with several parts of the normals per pixel, each with share, mean, covariance and a stretched base lobe.
// Includers define `const int parts`, `Part` and its functions (stretched_part.glsl), and `effective`. Their methods have
// the option `specular`, and the flag `part_colours`: with specular=joint parts have specular colours of their own.
//? include part_moments.glsl

struct Effective {
  Part part[parts];
  vec3 mean_normal;  // not renormalised: its dot product is the mean of the texels' own
//? if part_colours and specular_joint and specular_variation
  vec3 tint[parts];  // specular colour over that of the footprint, per unit of the share
//? end
};

float ndf(Effective e, vec3 h) {
  Direction at = directionOf(h);
  float sum = 0.0;
  for (int i = 0; i < parts; ++i) sum += partDensity(e.part[i], at);
  return sum;
}

// The geometry factor is that of single facets about the mean of the part.
Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo) {
  Reflected r;
  r.specular = vec3(0.0);
  if (halfVectorIsDefined(wi, wo)) {
    vec3 h = halfVector(wi, wo);
    Direction at = directionOf(h);
//? if part_colours and specular_joint and specular_variation
    for (int i = 0; i < parts; ++i) {
      r.specular += partDensity(e.part[i], at) * baseGeometry(e.part[i].lobe, e.part[i].axis, h, wi, wo) *
                    fresnelTerm(s.f0 * e.tint[i], wi, wo);
    }
//? else
    float sum = 0.0;
    for (int i = 0; i < parts; ++i)
      sum += partDensity(e.part[i], at) * baseGeometry(e.part[i].lobe, e.part[i].axis, h, wi, wo);
    r.specular = fresnelTerm(s.f0, wi, wo) * sum;
//? end
  }
  r.diffuse = diffuse(e.mean_normal, s, wi, wo);  //? if diffuse
  return r;
}

//? if lobes_listed
int lobeCount(Effective e) { return parts * lobes_per_part; }

NormalLobe normalLobe(Effective e, int i) { return partLobe(e.part[i / lobes_per_part], i % lobes_per_part); }

float lobeGeometry(Effective e, NormalLobe lobe, vec3 h, vec3 wi, vec3 wo) {
  return baseGeometry(lobe.base, lobe.normal, h, wi, wo);
}

vec3 meanNormal(Effective e) { return e.mean_normal; }
//? end
