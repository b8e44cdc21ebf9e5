// The lobes of one facet, which the map has joined with the normals: one about its normal, or several about axes of
// their own.
struct FacetsLobe {
  vec3 axis;
  float parameter, weight;
  float shortfall, energy;  // 1 - |r|, and what energyOf has for it
};

FacetsLobe facetsLobe(vec3 axis, float parameter, float weight) {
  return FacetsLobe(axis, parameter, weight, shortfallOf(kappaOfLobe(parameter)), energyOf(parameter));
}

// Where roughness varies, the lobe of the mean slope variance.
FacetsLobe baseLobe(Footprints f) {
//? if roughness_variation
  return facetsLobe(vec3(0.0, 0.0, 1.0), lobeFromVariance(fetch(xu_vmf_variances, f.roughness).r), 1.0);
//? else
  return facetsLobe(vec3(0.0, 0.0, 1.0), lobe_cutoff.x, 1.0);
//? end
}

//? if multi_lobe
int facetsLobeCount() { return max(facet_lobe_count, 1); }
FacetsLobe facetsLobeAt(Footprints f, int k) {
  if (facet_lobe_count > 0) return facetsLobe(facet_lobes[k].axis, facet_lobes[k].parameter, facet_lobes[k].weight);
  return baseLobe(f);
}
//? else
int facetsLobeCount() { return 1; }
FacetsLobe facetsLobeAt(Footprints f, int k) { return baseLobe(f); }
//? end
