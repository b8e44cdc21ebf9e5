// Smith's masking and shadowing by the facets of all lobes of a footprint, as LEADR has it for one lobe (Dupuy et al.
// 2013, section 4). G1(w) is the area of the mean surface seen along w over the area of all facets that face w.

// A lobe counts per area of the surface, which grows without limit for lobes that lean: none counts as steeper than a
// slope of 3, as in `lean`.
const float steepest_lobe = 0.31622777;  // its cosine

// The mean of max(w.m, 0) over the facets m of a lobe, for c = w.mean: c (1 + Lambda), in a form for any sign of c.
#if DISTRIBUTION_GGX
float facingArea(float base, float c) { return 0.5 * (c + sqrt(c * c + base * base * max(1.0 - c * c, 0.0))); }
#else
float facingArea(float base, float c) {
  float size = max(abs(c), 1e-4);
  return size * smithLambda(lobeAlpha(base), min(size, 1.0)) + max(c, 0.0);
}
#endif

// The factor on F D in f * cos: G2 / (4 n.v) about the mean surface, height-correlated (Heitz 2014, equation 99).
float footprintFactor(int count, vec3 wi, vec3 wo) {
  vec3 mean_area = vec3(0.0);
  vec2 facing = vec2(0.0);  // wi, wo
  for (int i = 0; i < count; ++i) {
    Lobe lobe = lobeOf(lobes[i], weights[i]);
    float area = shares[i].x / max(lobe.mean.z, steepest_lobe);
    mean_area += area * lobe.mean;
    facing += area * vec2(facingArea(lobe.base, dot(lobe.mean, wi)), facingArea(lobe.base, dot(lobe.mean, wo)));
  }
  vec2 seen = vec2(dot(mean_area, wi), dot(mean_area, wo));
  if (seen.x <= 0.0) return 0.0;
  seen.y = max(seen.y, 1e-4 * length(mean_area));
  vec2 lambda = max(facing / seen - 1.0, 0.0);
  return 0.25 * length(mean_area) / ((1.0 + lambda.x + lambda.y) * seen.y);
}
