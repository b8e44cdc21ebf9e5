// One texel's own facet: of many samples, or where normals do not vary.
struct Effective {
  vec3 normal;
};

Effective effective(Footprints f) {
//? if normal_variation
  return Effective(normalize(fetchFinest(mean_normal, folded(f.normal)).xyz));
//? else
  return Effective(vec3(0.0, 0.0, 1.0));
//? end
}

float ndf(Effective e, vec3 h) { return elementValue(e.normal, no_spread, Query(false, h, h, h)); }

Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo) {
  Reflected r;
  r.specular = vec3(0.0);
  if (halfVectorIsDefined(wi, wo)) {
    Query q = Query(true, halfVector(wi, wo), wi, wo);
    r.specular = fresnelTerm(s.f0, wi, wo) * elementValue(e.normal, no_spread, q);
  }
//? if diffuse
  r.diffuse = diffuse(e.normal, s, wi, wo);
//? end
  return r;
}
