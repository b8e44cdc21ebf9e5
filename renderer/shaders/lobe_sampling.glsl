// Draws normals from the lobes of facets, for the reference's integration of an environment.

// A right-handed frame whose third column is n (Duff et al. 2017).
mat3 frameAbout(vec3 n) {
  float s = n.z >= 0.0 ? 1.0 : -1.0;
  float a = -1.0 / (s + n.z);
  float b = n.x * n.y * a;
  return mat3(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

// 1 - e^x for x <= 0, without cancellation near 0.
float shortOfOne(float x) { return x > -1e-3 ? -x * (1.0 + 0.5 * x) : 1.0 - exp(x); }

// 1 - cos of the angle whose squared tangent is given.
float tiltOf(float tangent2) {
  float secant = sqrt(1.0 + tangent2);
  return tangent2 / (secant * (1.0 + secant));
}

// 1 - cos of a normal drawn from the lobe, and its density over solid angle. u is in (0, 1].
#if DISTRIBUTION_BLINN_PHONG
float drawnTilt(float s, float u) { return shortOfOne(log(u) / (s + 1.0)); }
#elif DISTRIBUTION_BECKMANN
float drawnTilt(float alpha, float u) { return tiltOf(-alpha * alpha * log(u)); }
#elif DISTRIBUTION_GGX
float drawnTilt(float alpha, float u) { return tiltOf(alpha * alpha * (1.0 - u) / u); }
#endif
#if DISTRIBUTION_VMF
float drawnTilt(float kappa, float u) {
  float k = max(kappa, 1e-3);
  return clamp(-log(u + (1.0 - u) * exp(-2.0 * k)) / k, 0.0, 2.0);
}
#endif
// For microfacets, the projected area integrates to one.
float drawnDensity(float lobe, vec3 n, vec3 h) {
#if DISTRIBUTION_BLINN_PHONG
  return lobeDensity(lobe, n, h);
#elif DISTRIBUTION_VMF
  return lobeDensity(max(lobe, 1e-3), n, h);
#else
  return lobeDensity(lobe, n, h) * max(dot(n, h), 0.0);
#endif
}

vec3 drawnNormal(float lobe, vec3 n, vec2 u) {
  float tilt = drawnTilt(lobe, max(1.0 - u.x, 1e-7));
  float sine = sqrt(max(tilt * (2.0 - tilt), 0.0));
  float azimuth = 2.0 * pi * u.y;
  return frameAbout(n) * vec3(sine * cos(azimuth), sine * sin(azimuth), 1.0 - tilt);
}

#if ANISOTROPIC_LOBE
// Slopes of the round lobe of alpha 1, stretched along the axes of the facet.
vec3 drawnBaseNormal(float lobe, vec3 n, vec2 u) {
  float left = max(1.0 - u.x, 1e-7);
#if DISTRIBUTION_GGX
  float tangent = sqrt((1.0 - left) / left);
#else
  float tangent = sqrt(-log(left));
#endif
  float azimuth = 2.0 * pi * u.y;
  vec2 slope = facetAlphas(lobe) * tangent * vec2(cos(azimuth), sin(azimuth));
  vec2 d = facetDirection();
  return turnedWithNormal(normalize(vec3(slope.x * d + slope.y * vec2(-d.y, d.x), 1.0)), n);
}
float drawnBaseDensity(float lobe, vec3 n, vec3 h) { return baseDensity(lobe, n, h) * max(dot(n, h), 0.0); }
#else
vec3 drawnBaseNormal(float lobe, vec3 n, vec2 u) { return drawnNormal(lobe, n, u); }
float drawnBaseDensity(float lobe, vec3 n, vec3 h) { return drawnDensity(lobe, n, h); }
#endif

#if MULTI_LOBE
float facetWeight() {
  float sum = 0.0;
  for (int k = 0; k < facet_lobe_count; ++k) sum += facet_lobes[k].weight;
  return sum;
}
#endif

// Draws a normal of facets; u.z selects the lobe.
vec3 drawnFacet(Facets f, vec3 u) {
#if MULTI_LOBE
  if (facet_lobe_count > 0) {
    float left = u.z * facetWeight();
    int k = 0;
    while (k < facet_lobe_count - 1 && left >= facet_lobes[k].weight) left -= facet_lobes[k++].weight;
    return drawnNormal(widenedLobe(k, f.spread), turnedWithNormal(facet_lobes[k].axis, f.normal), u.xy);
  }
#endif
  return drawnBaseNormal(f.lobe, f.normal, u.xy);
}

float drawnFacetDensity(Facets f, vec3 h) {
#if MULTI_LOBE
  if (facet_lobe_count > 0) {
    vec3 own = inFacetFrame(h, f.normal);
    float sum = 0.0;
    for (int k = 0; k < facet_lobe_count; ++k) {
      sum += facet_lobes[k].weight * drawnDensity(widenedLobe(k, f.spread), facet_lobes[k].axis, own);
    }
    return sum / facetWeight();
  }
#endif
  return drawnBaseDensity(f.lobe, f.normal, h);
}
