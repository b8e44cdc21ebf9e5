// The lobes of a facet, and the lobes that a pixel reflects with.

// A lobe of one facet, joined with the normals: one about its normal, or several about their own axes.
struct FacetsLobe {
  vec3 axis;
  float parameter, weight;
  float shortfall, energy;  // 1 - |r|, and energyOf the lobe
};

FacetsLobe facetsLobe(vec3 axis, float parameter, float weight) {
  return FacetsLobe(axis, parameter, weight, shortfallOf(kappaOfLobe(parameter)), energyOf(parameter));
}

// The lobe of the mean slope variance if the roughness varies.
FacetsLobe baseLobe(Footprints f) {
#if ROUGHNESS_VARIATION
  return facetsLobe(vec3(0.0, 0.0, 1.0), lobeFromVariance(fetch(xu_vmf_variances, f.roughness).r), 1.0);
#else
  return facetsLobe(vec3(0.0, 0.0, 1.0), lobe_cutoff.x, 1.0);
#endif
}

#if MULTI_LOBE
int facetsLobeCount() { return max(facet_lobe_count, 1); }
FacetsLobe facetsLobeAt(Footprints f, int k) {
  if (facet_lobe_count > 0) return facetsLobe(facet_lobes[k].axis, facet_lobes[k].parameter, facet_lobes[k].weight);
  return baseLobe(f);
}
#else
int facetsLobeCount() { return 1; }
FacetsLobe facetsLobeAt(Footprints f, int k) { return baseLobe(f); }
#endif

// While blending from one lobe to 4 parts, and from each of these to 2, there are 13.
#if J_1
const int most_of_one = 1;
#elif J_4
const int most_of_one = 4;
#elif THRESHOLDS_BLENDED
const int most_of_one = 13;
#else
const int most_of_one = 8;
#endif
#if MULTI_LOBE
const int most_lobes = most_of_one * most_facet_lobes;
#else
const int most_lobes = most_of_one;
#endif

// The data of the pixel's lobes that all lights share.
struct Effective {
  int count;      // of the valid lobes below, from the first on
  float covered;  // share of the footprint that lobes cover; divide weights by it
  vec3 normal;    // mean of the unit normals of facets with lobes of their own axes
};

// The lobes, which belong to Effective but are not passed with it. GLSL copies arrays that it passes, and Mesa does so
// for each light: in Effective they made a frame of carved_disk take 1.7 times as long. Lobes are compact, because
// accesses to an array by a variable index are expensive.
vec4 lobes[most_lobes];    // mean direction, and width: the parameter of the base lobe, or kappa
vec2 weights[most_lobes];  // of the density, and of the cosine of the mean normal
#if LOBES_LISTED || MASKING_FOOTPRINT
vec2 shares[most_lobes];   // the amount of the lobe, and the parameter of its facets' lobe
#endif

struct Lobe {
  vec3 mean;
#if !LOBE_BASE
  float kappa;
#endif
  float base;    // parameter of the base lobe of that width
  float amount;  // factor on its density
};

Lobe lobeOf(vec4 lobe, vec2 weights) {
#if LOBE_BASE
  return Lobe(lobe.xyz, lobe.w, weights.x);
#else
  return Lobe(lobe.xyz, lobe.w, lobeOfKappa(lobe.w), weights.x);
#endif
}

float densityOf(Lobe lobe, vec3 h) {
#if LOBE_BASE
  return lobeDensity(lobe.base, lobe.mean, h);
#else
  countLobes(1);
  return vmfDensity(lobe.kappa, lobe.mean, h);
#endif
}

// The divisor of the amounts. Algorithm 1 has none: it adds lobes without the weights of equation 15.
float amountsOf(float covered) {
#if VARIANT_ALGORITHM1
  return 1.0;
#else
  return covered;
#endif
}

// The integral of a lobe's density over the integral that facets give it. Line 25 of Algorithm 1 evaluates equation 7,
// which leaves the divisor of equation 6 out.
float printedEnergy(float kappa) {
#if VARIANT_CORRECTED || LOBE_BASE
  return 1.0;
#else
  return oneMinusExp2(kappa);
#endif
}

// A lobe as stored in the arrays.
struct StoredLobe {
  vec4 lobe;
  vec2 weights;
  vec2 share;
};

void addLobe(inout int count, StoredLobe added) {
  lobes[count] = added.lobe;
  weights[count] = added.weights;
#if LOBES_LISTED || MASKING_FOOTPRINT
  shares[count] = added.share;
#endif
  ++count;
}

// `q`: 1 - |r| of the mean lobe; `width_q`: that of the lobe that reflects, which differs in Algorithm 1 alone, as does
// `amount`, the factor of its density.
StoredLobe storedLobe(FacetsLobe own, vec3 mean, float q, float width_q, float share, float amount) {
  float kappa = kappaOf(width_q);
  float base = lobeOfKappa(kappa);
  amount *= printedEnergy(kappa);
#if SAMPLING_TEXEL
  // The lobe of the single texel that was drawn is that of a facet. The roughness map may have drawn another one.
  own.shortfall = q;
  own.energy = energyOf(base);
  own.parameter = base;
#endif
  // The mean resultant length of the facets' normals: |r| over that of a single facet.
  float normal_length = min((1.0 - q) / max(1.0 - own.shortfall, 1e-6), 1.0);
#if LOBE_BASE
  vec4 lobe = vec4(mean, base);
#else
  vec4 lobe = vec4(mean, kappa);
#endif
  return StoredLobe(lobe, vec2(amount * own.energy / energyOf(base), share * normal_length), vec2(amount, own.parameter));
}
