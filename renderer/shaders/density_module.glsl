// `shade` of a module whose facets reflect about the half vector. Includers define `Effective`, `meanNormal`, and
// `reflectedDensity`: f * cos without the Fresnel term.
float reflectedDensity(Effective e, vec3 h, vec3 wi, vec3 wo);

Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo) {
  Reflected r;
  r.specular = vec3(0.0);
  if (halfVectorIsDefined(wi, wo))
    r.specular = fresnelTerm(s.f0, wi, wo) * reflectedDensity(e, halfVector(wi, wo), wi, wo);
#if DIFFUSE
  r.diffuse = diffuse(meanNormal(e), s, wi, wo);
#endif
  return r;
}
