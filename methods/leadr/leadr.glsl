// Dupuy et al. 2013 (LEADR): one off-centre lobe over the footprint's slopes, and masking, shadowing and diffuse
// reflection of a surface with those slopes.
//? if roughness_stretched
//? include stretched_slopes.glsl
//? else
const bool base_in_moments = true;   //? if normal_variation and roughness_moments
const bool base_in_moments = false;  //? else
//? include gaussian_slopes.glsl
//? end
//? include full_moments.glsl
//? include lobe_variance.glsl if not (normal_variation and roughness_moments)

float addedVariance(Footprints f) {
  return 0.0;              //? if normal_variation and roughness_moments
  return baseVariance(f);  //? else
}

// Smith's masking for slopes with a mean. Displaced texels are always masked by their slopes.
//? include beckmann_lambda.glsl if masking_shadowing and geometry_smith or weighting_displacement

struct Effective {
  SlopeLobe lobe;
  float round_lobe;  // parameter of the round base lobe of the same breadth, for terms other than Smith's
  mat2 root;  // of the covariance, symmetric  //? if diffuse
  LobeRow row;  //? if lobes_listed
};

Effective effective(Footprints f) {
  Effective e;
  e.lobe = footprintLobe(f, filteredSlopes(f));
  e.round_lobe = lobeFromVariance(e.lobe.breadth);
  e.row = lobeRow(e.lobe);  //? if lobes_listed
  e.root = covarianceRoot(e.lobe.spread);  //? if diffuse
  return e;
}

// (w.n) / n_z of the mean slope: the area of the mean surface visible along w, per area of the plane.
float meanProjectedArea(SlopeLobe lobe, vec3 w) { return max(dot(lobe.axis, w), 1e-4) * lobe.secant; }

//? if masking_shadowing and geometry_smith or weighting_displacement
// Smith's Lambda of slopes whose component towards w has a mean and a variance. It depends only on
// a = (cot + mean) / (sqrt(2) deviation) (Dupuy 2013, section 4). Both are multiplied by the sine, which may be 0.
float offCentreLambda(float projected_area, float variance) {
  float inverse_a2 = 2.0 * variance / (projected_area * projected_area);
//? if distribution_ggx and roughness_stretched
  // The same a of an elliptical GGX (Heitz 2014, equation 72), in a form without cancellation.
  return 0.5 * inverse_a2 / (1.0 + sqrt(1.0 + inverse_a2));
//? else
  return beckmannLambda(1.0 / max(sqrt(inverse_a2), 1e-6));
//? end
}

// Lambda of the texels' slopes.
float spreadLambda(SlopeLobe lobe, vec3 w) {
  return offCentreLambda(meanProjectedArea(lobe, w), max(dot(w.xy, lobe.spread * w.xy), 0.0));
}
//? end

//? if masking_shadowing and geometry_smith
// Lambda of the texels' slopes and the base lobe's. A stretched base lobe is about the mean normal, where 1 / a^2 is
// 2 v tan^2. The share makes it so, and a flat map has the base BRDF's own Lambda at any tilt.
float lobeLambda(SlopeLobe lobe, vec3 w) {
//? if roughness_stretched and anisotropic_lobe
  vec2 sine = lobe.secant * inFacetFrame(w, lobe.axis).xy;
  float base = dot(sine, baseCovariance(lobe.base) * sine);
//? elif roughness_stretched
  vec3 sine = lobe.secant * cross(lobe.axis, w);
  float base = lobe.base * dot(sine, sine);
//? elif anisotropic_lobe
  float base = dot(w.xy, baseCovariance(lobe.base) * w.xy);
//? else
  float base = lobe.base * dot(w.xy, w.xy);
//? end
  return offCentreLambda(meanProjectedArea(lobe, w), max(dot(w.xy, lobe.spread * w.xy), 0.0) + base);
}
//? end

//? if weighting_displacement
// The mean normal of the texels that reflect about h. A slope is the sum of two independent Gaussians, the texel's and the
// base lobe's; this is the mean of the texel's, given the sum.
vec3 texelNormal(SlopeLobe lobe, vec3 h) {
  vec2 offset = -h.xy / max(h.z, smallest_slope_cosine) - lobe.mean;
//? if roughness_stretched
  return normalOfSlope(lobe.mean + offset - lobe.shape * (lobe.shape * offset));  // 1 - W (S + W)^-1 = 1 - shape^2
//? else
  return normalOfSlope(lobe.mean + lobe.spread * (lobe.shape * offset));
//? end
}
//? end

// Bump: all texels have the same weight. Displacement: a texel is weighted by its true area 1 / n_z, relative to the
// mean's.
float ndf(Effective e, vec3 h) {
  return slopeDensity(e.lobe, h) * e.lobe.axis.z / texelNormal(e.lobe, h).z;  //? if weighting_displacement
  return slopeDensity(e.lobe, h);                                             //? else
}

// The factor on F D in f * cos.
float factor(Effective e, vec3 h, vec3 wi, vec3 wo) {
//? if masking_shadowing and geometry_smith
  // G2 / (4 n.v), height-correlated. The visible area (n.v) of a displaced texel cancels its 1 / (n.v), and the mean's
  // remains.
  if (dot(e.lobe.axis, wi) <= 0.0) return 0.0;
  return 0.25 / ((1.0 + lobeLambda(e.lobe, wo) + lobeLambda(e.lobe, wi)) * max(dot(e.lobe.axis, wo), 1e-4));
//? elif weighting_displacement
  // The base BRDF has no masking, but a displaced texel is weighted by its visible area.
  vec3 n = texelNormal(e.lobe, h);
  float visible = max(dot(n, wo), 0.0) / (meanProjectedArea(e.lobe, wo) * (1.0 + spreadLambda(e.lobe, wo)));
  return visible * e.lobe.secant * geometryFactor(e.round_lobe, n, h, wi, wo);
//? else
  return geometryFactor(e.round_lobe, e.lobe.axis, h, wi, wo);
//? end
}

//? if diffuse
// The mean of max(n.l, 0) over the texels, by 3 x 3 Gauss-Hermite points (exact to degree 5 in the slopes). Displaced
// texels are weighted by their visible area, and visible ones may be in shadow.
float meanLitCosine(Effective e, vec3 wi, vec3 wo) {
  float lit = 0.0;
  float seen = 0.0;
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      vec3 n = normalOfSlope(e.lobe.mean + e.root * (1.7320508 * vec2(i, j)));
      float weight = (i == 0 ? 4.0 : 1.0) * (j == 0 ? 4.0 : 1.0);
      weight *= max(dot(n, wo), 0.0) / n.z;  //? if weighting_displacement
      lit += weight * max(dot(n, wi), 0.0);
      seen += weight;
    }
  }
  float mean = lit / max(seen, 1e-6);
//? if masking_shadowing and geometry_smith and weighting_displacement
  float masked = 1.0 + spreadLambda(e.lobe, wo);
  mean *= masked / (masked + spreadLambda(e.lobe, wi));
//? end
  return mean;
}
//? end

Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo) {
  Reflected r;
  r.specular = vec3(0.0);
  if (halfVectorIsDefined(wi, wo)) {
    vec3 h = halfVector(wi, wo);
    r.specular = fresnelTerm(s.f0, wi, wo) * (ndf(e, h) * factor(e, h, wi, wo));
  }
  r.diffuse = diffuse(meanLitCosine(e, wi, wo) * wi, s, wi, wo);  //? if diffuse
  return r;
}

//? if lobes_listed
int lobeCount(Effective e) { return 2 * e.row.half_count + 1; }

NormalLobe normalLobe(Effective e, int i) { return lobeOfRow(e.lobe, e.row, i); }

float lobeGeometry(Effective e, NormalLobe lobe, vec3 h, vec3 wi, vec3 wo) { return factor(e, h, wi, wo); }

vec3 meanNormal(Effective e) {
  return meanOfSlopes(e.lobe.mean, e.root);  //? if diffuse
  return vec3(0.0);                          //? else
}
//? end
