// The specular term of parts_module.glsl where all parts have the specular colour of the footprint.
vec3 partsSpecular(Effective e, Surface s, vec3 h, vec3 wi, vec3 wo) {
  Direction at = directionOf(h);
  float sum = 0.0;
  for (int i = 0; i < parts; ++i) sum += partReflectance(e.part[i], at, h, wi, wo);
  return fresnelTerm(s.f0, wi, wo) * sum;
}
