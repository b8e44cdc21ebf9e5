// For environment light, the lobes of a module whose Effective holds its NDF as `facets`.
//? if multi_lobe
int lobeCount(Effective e) { return max(facet_lobe_count, 1); }

NormalLobe normalLobe(Effective e, int i) {
  if (facet_lobe_count == 0) return baseNormalLobe(e.facets.normal, e.facets.lobe, 1.0);
  vec3 axis = turnedWithNormal(facet_lobes[i].axis, e.facets.normal);
  return baseNormalLobe(axis, widenedLobe(i, e.facets.spread), facet_lobes[i].weight);
}
//? else
int lobeCount(Effective e) { return 1; }

NormalLobe normalLobe(Effective e, int i) { return baseNormalLobe(e.facets.normal, e.facets.lobe, 1.0); }
//? end

float lobeGeometry(Effective e, NormalLobe lobe, vec3 h, vec3 wi, vec3 wo) {
  return geometryFactor(lobe.base, e.facets.normal, h, wi, wo);
}
