// The effective NDF as lobes over half vectors, which modules provide for environment light.

#include "vmf.glsl"

// A spherical Gaussian over half vectors, e^{sharpness ((axis.h) - 1)}.
struct NormalLobe {
  vec3 axis;        // unit, tangent frame
  float sharpness;  // kappa, above 0
  float weight;     // the lobe's integral of D(h) (axis.h): what its facets cover seen along its axis
  float base;       // parameter of the base lobe that the geometry factor takes for it
  bool tailed;      // GGX of alpha^2 = 2 / sharpness, its tail included
  vec3 normal;      // of the facets, for the geometry factor: the axis, but for facets with lobes about other axes
};

// The facets as the diffuse term sees them under an environment.
struct DiffuseFacets {
  vec3 mean_normal;  // not renormalised
  vec3 share;        // reflected of a constant environment, over the albedo
  bool whole;        // `share` has the albedo in it, and no Fresnel term takes from it
};

// A von Mises-Fisher lobe with a `share` of the footprint.
NormalLobe vmfNormalLobe(vec3 axis, float kappa, float share, float base) {
  return NormalLobe(axis, max(kappa, 1e-3), share * meanCosine(kappa), base, false, axis);
}

// The base lobe about an axis, with a `share` of the footprint. Its width is that of the lobe near its peak. The
// integral of D(h) (axis.h) is one for a microfacet lobe and (s + 1) / (s + 2) for a Blinn-Phong lobe.
NormalLobe baseNormalLobe(vec3 axis, float lobe, float share) {
#if DISTRIBUTION_BLINN_PHONG
  return NormalLobe(axis, lobe + 1.0, share * (lobe + 1.0) / (lobe + 2.0), lobe, false, axis);
#endif
#if DISTRIBUTION_VMF
  return vmfNormalLobe(axis, lobe, share, lobe);
#endif
#if DISTRIBUTION_BECKMANN
  return NormalLobe(axis, 2.0 / (lobe * lobe), share, lobe, false, axis);
#endif
#if DISTRIBUTION_GGX
  return NormalLobe(axis, 2.0 / (lobe * lobe), share, lobe, true, axis);
#endif
}

#if ANISOTROPIC_LOBE
#include "lobe_row.glsl"
#endif

// The lobes of facets with a `share` of the footprint.
#if ANISOTROPIC_LOBE
int baseRowCount() { return row_count; }
NormalLobe baseRowLobe(Facets f, int k, float share) { return lobeOfWidths(squaredWidths(f.lobe), f.normal, k, share); }
#else
int baseRowCount() { return 1; }
NormalLobe baseRowLobe(Facets f, int k, float share) { return baseNormalLobe(f.normal, f.lobe, share); }
#endif

#if MULTI_LOBE
int facetLobeCount() { return facet_lobe_count == 0 ? baseRowCount() : facet_lobe_count; }

NormalLobe facetNormalLobe(Facets f, int k, float share) {
  if (facet_lobe_count == 0) return baseRowLobe(f, k, share);
  vec3 axis = turnedWithNormal(facet_lobes[k].axis, f.normal);
  NormalLobe lobe = baseNormalLobe(axis, widenedLobe(k, f.spread), share * facet_lobes[k].weight);
  lobe.normal = f.normal;
  return lobe;
}
#else
int facetLobeCount() { return baseRowCount(); }
NormalLobe facetNormalLobe(Facets f, int k, float share) { return baseRowLobe(f, k, share); }
#endif
