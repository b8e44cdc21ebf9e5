// For environment light, the lobe of a module whose Effective is one base lobe: `lobe` about `normal`.
int lobeCount(Effective e) { return 1; }

NormalLobe normalLobe(Effective e, int i) { return baseNormalLobe(e.normal, e.lobe, 1.0); }

float lobeGeometry(Effective e, NormalLobe lobe, vec3 h, vec3 wi, vec3 wo) {
  return geometryFactor(lobe.base, lobe.axis, h, wi, wo);
}
