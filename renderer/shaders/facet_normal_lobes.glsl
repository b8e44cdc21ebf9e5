// The lobes for environment light of a module whose Effective has `facets`.
int lobeCount(Effective e) { return facetLobeCount(); }

NormalLobe normalLobe(Effective e, int i) { return facetNormalLobe(e.facets, i, 1.0); }

float lobeGeometry(Effective e, NormalLobe lobe, vec3 h, vec3 wi, vec3 wo) {
#if ANISOTROPIC_LOBE
  return baseGeometry(e.facets.lobe, lobe.normal, h, wi, wo);
#else
  return geometryFactor(lobe.base, lobe.normal, h, wi, wo);
#endif
}
