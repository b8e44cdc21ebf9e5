// Dupuy et al. 2013 (LEADR): one off-centre lobe over the footprint's slopes, and masking, shadowing and diffuse
// reflection of a surface with those slopes.
#if ROUGHNESS_STRETCHED
#include "stretched_slopes.glsl"
#else
#if NORMAL_VARIATION && ROUGHNESS_MOMENTS
const bool base_in_moments = true;
#else
const bool base_in_moments = false;
#endif
#include "gaussian_slopes.glsl"
#endif
#include "full_moments.glsl"
#if !(NORMAL_VARIATION && ROUGHNESS_MOMENTS)
#include "lobe_variance.glsl"
#endif

float addedVariance(Footprints f) {
#if NORMAL_VARIATION && ROUGHNESS_MOMENTS
  return 0.0;
#else
  return baseVariance(f);
#endif
}

// Smith's masking for slopes with a mean. Displaced texels are always masked by their slopes.
#if MASKING_SHADOWING && GEOMETRY_SMITH || WEIGHTING_DISPLACEMENT
#include "beckmann_lambda.glsl"
#endif

struct Effective {
  SlopeLobe lobe;
  float round_lobe;  // parameter of the round base lobe of the same breadth, for terms other than Smith's
#if DIFFUSE
  mat2 root;  // of the covariance, symmetric
#endif
#if LOBES_LISTED
  LobeRow row;
#endif
};

Effective effective(Footprints f) {
  Effective e;
  e.lobe = footprintLobe(f, filteredSlopes(f));
  e.round_lobe = lobeFromVariance(e.lobe.breadth);
#if LOBES_LISTED
  e.row = lobeRow(e.lobe);
#endif
#if DIFFUSE
  e.root = covarianceRoot(e.lobe.spread);
#endif
  return e;
}

// (w.n) / n_z of the mean slope: the area of the mean surface visible along w, per area of the plane.
float meanProjectedArea(SlopeLobe lobe, vec3 w) { return max(dot(lobe.axis, w), 1e-4) * lobe.secant; }

#if MASKING_SHADOWING && GEOMETRY_SMITH || WEIGHTING_DISPLACEMENT
// Smith's Lambda of slopes whose component towards w has a mean and a variance. It depends only on
// a = (cot + mean) / (sqrt(2) deviation) (Dupuy 2013, section 4). Both are multiplied by the sine, which may be 0.
float offCentreLambda(float projected_area, float variance) {
  float inverse_a2 = 2.0 * variance / (projected_area * projected_area);
#if DISTRIBUTION_GGX && ROUGHNESS_STRETCHED
  // Lambda of an elliptical GGX by the same a (Heitz 2014, equation 72), in a form without cancellation.
  return 0.5 * inverse_a2 / (1.0 + sqrt(1.0 + inverse_a2));
#else
  return beckmannLambda(1.0 / max(sqrt(inverse_a2), 1e-6));
#endif
}

// Lambda of the texels' slopes.
float spreadLambda(SlopeLobe lobe, vec3 w) {
  return offCentreLambda(meanProjectedArea(lobe, w), max(dot(w.xy, lobe.spread * w.xy), 0.0));
}
#endif

#if MASKING_SHADOWING && GEOMETRY_SMITH
// Lambda of the texels' slopes and the base lobe's. A stretched base lobe is about the mean normal, where 1 / a^2 is
// 2 v tan^2. The share makes it so, and a flat map has the base BRDF's own Lambda at any tilt.
float lobeLambda(SlopeLobe lobe, vec3 w) {
#if ROUGHNESS_STRETCHED && ANISOTROPIC_LOBE
  vec2 sine = lobe.secant * inFacetFrame(w, lobe.axis).xy;
  float base = dot(sine, baseCovariance(lobe.base) * sine);
#elif ROUGHNESS_STRETCHED
  vec3 sine = lobe.secant * cross(lobe.axis, w);
  float base = lobe.base * dot(sine, sine);
#elif ANISOTROPIC_LOBE
  float base = dot(w.xy, baseCovariance(lobe.base) * w.xy);
#else
  float base = lobe.base * dot(w.xy, w.xy);
#endif
  return offCentreLambda(meanProjectedArea(lobe, w), max(dot(w.xy, lobe.spread * w.xy), 0.0) + base);
}
#endif

#if WEIGHTING_DISPLACEMENT
// The mean normal of the texels that reflect about h. A slope is the sum of two independent Gaussians, the texel's and the
// base lobe's; this is the mean of the texel's, given the sum.
vec3 texelNormal(SlopeLobe lobe, vec3 h) {
  vec2 offset = -h.xy / max(h.z, smallest_slope_cosine) - lobe.mean;
#if ROUGHNESS_STRETCHED
  return normalOfSlope(lobe.mean + offset - lobe.shape * (lobe.shape * offset));  // 1 - W (S + W)^-1 = 1 - shape^2
#else
  return normalOfSlope(lobe.mean + lobe.spread * (lobe.shape * offset));
#endif
}
#endif

// Bump: all texels have the same weight. Displacement: a texel is weighted by its true area 1 / n_z, relative to the
// mean's.
float ndf(Effective e, vec3 h) {
#if WEIGHTING_DISPLACEMENT
  return slopeDensity(e.lobe, h) * e.lobe.axis.z / texelNormal(e.lobe, h).z;
#else
  return slopeDensity(e.lobe, h);
#endif
}

// The factor on F D in f * cos.
float factor(Effective e, vec3 h, vec3 wi, vec3 wo) {
#if MASKING_SHADOWING && GEOMETRY_SMITH
  // G2 / (4 n.v), height-correlated. The visible area (n.v) of a displaced texel cancels its 1 / (n.v), and the mean's
  // remains.
  if (dot(e.lobe.axis, wi) <= 0.0) return 0.0;
  return 0.25 / ((1.0 + lobeLambda(e.lobe, wo) + lobeLambda(e.lobe, wi)) * max(dot(e.lobe.axis, wo), 1e-4));
#elif WEIGHTING_DISPLACEMENT
  // The base BRDF has no masking, but a displaced texel is weighted by its visible area.
  vec3 n = texelNormal(e.lobe, h);
  float visible = max(dot(n, wo), 0.0) / (meanProjectedArea(e.lobe, wo) * (1.0 + spreadLambda(e.lobe, wo)));
  return visible * e.lobe.secant * geometryFactor(e.round_lobe, n, h, wi, wo);
#else
  return geometryFactor(e.round_lobe, e.lobe.axis, h, wi, wo);
#endif
}

#if DIFFUSE
// The mean of max(n.l, 0) over the texels, by 3 x 3 Gauss-Hermite points (exact to degree 5 in the slopes). Displaced
// texels are weighted by their visible area, and visible ones may be in shadow.
float meanLitCosine(Effective e, vec3 wi, vec3 wo) {
  float lit = 0.0;
  float seen = 0.0;
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      vec3 n = normalOfSlope(e.lobe.mean + e.root * (1.7320508 * vec2(i, j)));
      float weight = (i == 0 ? 4.0 : 1.0) * (j == 0 ? 4.0 : 1.0);
#if WEIGHTING_DISPLACEMENT
      weight *= max(dot(n, wo), 0.0) / n.z;
#endif
      lit += weight * max(dot(n, wi), 0.0);
      seen += weight;
    }
  }
  float mean = lit / max(seen, 1e-6);
#if MASKING_SHADOWING && GEOMETRY_SMITH && WEIGHTING_DISPLACEMENT
  float masked = 1.0 + spreadLambda(e.lobe, wo);
  mean *= masked / (masked + spreadLambda(e.lobe, wi));
#endif
  return mean;
}
#endif

Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo) {
  Reflected r;
  r.specular = vec3(0.0);
  if (halfVectorIsDefined(wi, wo)) {
    vec3 h = halfVector(wi, wo);
    r.specular = fresnelTerm(s.f0, wi, wo) * (ndf(e, h) * factor(e, h, wi, wo));
  }
#if DIFFUSE
  r.diffuse = diffuse(meanLitCosine(e, wi, wo) * wi, s, wi, wo);
#endif
  return r;
}

#if LOBES_LISTED
int lobeCount(Effective e) { return 2 * e.row.half_count + 1; }

NormalLobe normalLobe(Effective e, int i) { return lobeOfRow(e.lobe, e.row, i); }

float lobeGeometry(Effective e, NormalLobe lobe, vec3 h, vec3 wi, vec3 wo) { return factor(e, h, wi, wo); }

vec3 meanNormal(Effective e) {
#if DIFFUSE
  return meanOfSlopes(e.lobe.mean, e.root);
#else
  return vec3(0.0);
#endif
}
#endif
