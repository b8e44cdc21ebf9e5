/*
name = "lean"
summary = "One anisotropic lobe over the mean and the covariance of the footprint's slopes."
paper = "Olano and Baker 2010, LEAN Mapping, I3D"
reads = ["slope_moments"]
leaves_out = ["multi_lobe"]
*/
// Olano and Baker 2010: recovers mean and covariance of the footprint's slopes from filtered moments, and evaluates one
// lobe with them. The scalar variant, CLEAN, stores only the trace of the covariance.
//? if roughness_stretched
//? include stretched_slopes.glsl
//? else
const bool base_in_moments = true;   //? if normal_variation and roughness_moments
const bool base_in_moments = false;  //? else
//? include gaussian_slopes.glsl
//? end
//? include scalar_moments.glsl if variant_clean
//? include full_moments.glsl if not variant_clean
//? include lobe_variance.glsl if averages_variance and not (normal_variation and roughness_moments)
//? include mean_roughness.glsl if averages_roughness

float addedVariance(Footprints f) {
  return 0.0;                                            //? if normal_variation and roughness_moments
  return baseVariance(f);                                //? elif averages_variance
  return lobeVariance(baseLobe(f));                      //? elif averages_roughness
  return lobeVariance(fetch(mean_lobe, f.roughness).r);  //? elif roughness_variation
  return lobeVariance(lobe_cutoff.x);                    //? else
}

struct Effective {
  SlopeLobe lobe;
  float round_lobe;  // parameter of the round base lobe of the same breadth, for the geometry term
  vec3 mean_normal;  // not renormalised: its dot product is the mean of the texels'
  LobeRow row;  //? if lobes_listed
};

Effective effective(Footprints f) {
  Effective e;
  FilteredSlopes slopes = filteredSlopes(f);
  e.lobe = footprintLobe(f, slopes);
  e.round_lobe = lobeFromVariance(e.lobe.breadth);
  e.row = lobeRow(e.lobe);  //? if lobes_listed
  e.mean_normal = vec3(0.0, 0.0, 1.0);
  e.mean_normal = meanOfSlopes(e.lobe.mean, covarianceRoot(e.lobe.spread));  //? if diffuse and normal_layers
  e.mean_normal = slopes.mean_normal;  //? elif diffuse and normal_variation
  return e;
}

float ndf(Effective e, vec3 h) { return slopeDensity(e.lobe, h); }

// The geometry factor besides F and D in f * cos.
float factor(Effective e, vec3 h, vec3 wi, vec3 wo) {
  return stretchedGeometry(e.lobe.widths, e.round_lobe, e.lobe.axis, h, wi, wo);  //? if anisotropic_lobe
  return geometryFactor(e.round_lobe, e.lobe.axis, h, wi, wo);                    //? else
}

float reflectedDensity(Effective e, vec3 h, vec3 wi, vec3 wo) { return ndf(e, h) * factor(e, h, wi, wo); }

vec3 meanNormal(Effective e) { return e.mean_normal; }

//? include density_module.glsl

//? if lobes_listed
int lobeCount(Effective e) { return 2 * e.row.half_count + 1; }

NormalLobe normalLobe(Effective e, int i) { return lobeOfRow(e.lobe, e.row, i); }

float lobeGeometry(Effective e, NormalLobe lobe, vec3 h, vec3 wi, vec3 wo) { return factor(e, h, wi, wo); }
//? end
