/*
name = "lean"
summary = "One anisotropic lobe over the mean and the covariance of the footprint's slopes."
paper = "Olano and Baker 2010, LEAN Mapping, I3D"
reads = ["slope_moments"]
leaves_out = ["multi_lobe"]
*/
// Olano and Baker 2010: recovers mean and covariance of the footprint's slopes from filtered moments, and evaluates one
// lobe with them. The scalar variant, CLEAN, stores only the trace of the covariance.
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
#if VARIANT_CLEAN
#include "scalar_moments.glsl"
#else
#include "full_moments.glsl"
#endif
#if AVERAGES_VARIANCE && !(NORMAL_VARIATION && ROUGHNESS_MOMENTS)
#include "lobe_variance.glsl"
#endif
#if AVERAGES_ROUGHNESS
#include "mean_roughness.glsl"
#endif

float addedVariance(Footprints f) {
#if NORMAL_VARIATION && ROUGHNESS_MOMENTS
  return 0.0;
#elif AVERAGES_VARIANCE
  return baseVariance(f);
#elif AVERAGES_ROUGHNESS
  return lobeVariance(baseLobe(f));
#elif ROUGHNESS_VARIATION
  return lobeVariance(fetch(mean_lobe, f.roughness).r);
#else
  return lobeVariance(lobe_cutoff.x);
#endif
}

struct Effective {
  SlopeLobe lobe;
  float round_lobe;  // parameter of the round base lobe of the same breadth, for the geometry term
  vec3 mean_normal;  // not renormalised: its dot product is the mean of the texels'
#if LOBES_LISTED
  LobeRow row;
#endif
};

Effective effective(Footprints f) {
  Effective e;
  FilteredSlopes slopes = filteredSlopes(f);
  e.lobe = footprintLobe(f, slopes);
  e.round_lobe = lobeFromVariance(e.lobe.breadth);
#if LOBES_LISTED
  e.row = lobeRow(e.lobe);
#endif
  e.mean_normal = vec3(0.0, 0.0, 1.0);
#if DIFFUSE && NORMAL_LAYERS
  e.mean_normal = meanOfSlopes(e.lobe.mean, covarianceRoot(e.lobe.spread));
#elif DIFFUSE && NORMAL_VARIATION
  e.mean_normal = slopes.mean_normal;
#endif
  return e;
}

float ndf(Effective e, vec3 h) { return slopeDensity(e.lobe, h); }

// The geometry factor besides F and D in f * cos.
float factor(Effective e, vec3 h, vec3 wi, vec3 wo) {
#if ANISOTROPIC_LOBE
  return stretchedGeometry(e.lobe.widths, e.round_lobe, e.lobe.axis, h, wi, wo);
#else
  return geometryFactor(e.round_lobe, e.lobe.axis, h, wi, wo);
#endif
}

float reflectedDensity(Effective e, vec3 h, vec3 wi, vec3 wo) { return ndf(e, h) * factor(e, h, wi, wo); }

vec3 meanNormal(Effective e) { return e.mean_normal; }

#include "density_module.glsl"

#if LOBES_LISTED
int lobeCount(Effective e) { return 2 * e.row.half_count + 1; }

NormalLobe normalLobe(Effective e, int i) { return lobeOfRow(e.lobe, e.row, i); }

float lobeGeometry(Effective e, NormalLobe lobe, vec3 h, vec3 wi, vec3 wo) { return factor(e, h, wi, wo); }
#endif
