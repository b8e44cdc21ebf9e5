// Environment light: drawn normals, each with what a texel reflects by, are the lobes of the NDF.

//? if roughness_lobe
int lobesOfTexel() { return facetLobeCount(); }

NormalLobe lobeOfTexel(float variance, vec3 normal, int k, float share) {
  return facetNormalLobe(spreadFacets(normal, variance, 0.0), k, share);
}
//? else
int lobesOfTexel() { return 1; }

NormalLobe lobeOfTexel(float variance, vec3 normal, int k, float share) {
//? if roughness_bin
  const float sharpness = 1e6;  // a mirror: no map of an environment is as sharp
//? else
  float sharpness = 1.0 / variance;
//? end
  return NormalLobe(normal, sharpness, share, lobeFromVariance(variance), false, normal);
}
//? end

int lobeCount(Effective e) { return lobesOfTexel() * drawCount(e); }

NormalLobe normalLobe(Effective e, int i) {
  int number = i / lobesOfTexel();
  DrawnTexel texel = drawnTexel(e, number);
  vec3 normal = normalOf(texel.code, evenPoint(number).zw);
  NormalLobe lobe = lobeOfTexel(texel.variance, normal, i - number * lobesOfTexel(), texel.share);
//? if surface_microfacets
  // Walter 2007: D over the cosine, masked about the surface's own normal.
  lobe.weight /= max(lobe.axis.z, 1e-3);
  lobe.normal = vec3(0.0, 0.0, 1.0);
//? end
  return lobe;
}

float lobeGeometry(Effective e, NormalLobe lobe, vec3 h, vec3 wi, vec3 wo) {
  return geometryFactor(lobe.base, lobe.normal, h, wi, wo);
}
