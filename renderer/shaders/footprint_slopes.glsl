// The slopes under the footprint of a pixel, from the textures of `bake_slopes` (renderer/bake/slope_moments.hpp) plus
// a bump layer, and the lobe of common_slopes.glsl over them. The flag `with_mean_normal` says whether the textures
// include the mean normal, for a diffuse term over one map only.
//? include common_slopes.glsl
//? include lobe_variance.glsl if averages_variance and (not normal_variation or not roughness_moments)
//? include mean_roughness.glsl if averages_roughness

// As `fetch`, for two textures of the same size, in one loop over the probes.
void fetchPair(sampler2D first, sampler2D second, Footprint f, out vec4 of_first, out vec4 of_second) {
//? if sampling_frame and not filter_hardware
  Probes p = probesOf(vec2(textureSize(first, 0)), f);
  countLookups(2 * p.count);
  of_first = vec4(0.0);
  of_second = vec4(0.0);
  int i = 0;
  do {
    vec2 uv = probeUv(f, p, i);
    float weight = probeWeight(p, i);
    of_first += weight * textureLod(first, uv, p.level);
    of_second += weight * textureLod(second, uv, p.level);
  } while (++i < p.count);
//? else
  of_first = fetch(first, f);
  of_second = fetch(second, f);
//? end
}

struct FilteredSlopes {
  vec2 mean;
  mat2 spread;  // covariance
  vec3 mean_normal;  // not renormalised  //? if with_mean_normal and diffuse and normal_variation and not normal_layers
};

//? if variant_clean
mat2 spreadOf(vec4 moments, vec4 rest) { return mat2(scalarCovariance(moments.xy, moments.z)); }
//? else
mat2 spreadOf(vec4 moments, vec4 rest) { return slopeCovariance(moments.xy, vec3(moments.z, rest.x, moments.w)); }
//? end

FilteredSlopes filteredSlopes(Footprints f) {
  FilteredSlopes s;
  s.mean = vec2(0.0);
  s.spread = mat2(0.0);
  vec4 moments = vec4(0.0);
  vec4 rest = vec4(0.0);
//? if normal_variation
//? if variant_clean and (normal_layers or not diffuse or not with_mean_normal)
  moments = fetch(slope_moments, f.normal);
//? else
  fetchPair(slope_moments, slope_rest, f.normal, moments, rest);
//? end
  s.mean = moments.xy;
  s.spread = spreadOf(moments, rest);
//? if with_mean_normal and diffuse and not normal_layers
  s.mean_normal = rest.xyz;  //? if variant_clean
  s.mean_normal = rest.yzw;  //? else
//? end
//? end
//? if normal_layers
  // Slopes of independent layers add, and so do means and covariances; adding these has the least cancellation.
  moments = fetch(layer_moments, f.layer);                       //? if variant_clean
  fetchPair(layer_moments, layer_rest, f.layer, moments, rest);  //? else
  s.mean += moments.xy;
  s.spread += spreadOf(moments, rest);
//? end
  return s;
}

// The slope variance of the base lobe that the moments do not include.
float addedVariance(Footprints f) {
  return 0.0;                                            //? if normal_variation and roughness_moments
  return baseVariance(f);                                //? elif averages_variance
  return lobeVariance(baseLobe(f));                      //? elif averages_roughness
  return lobeVariance(fetch(mean_lobe, f.roughness).r);  //? elif roughness_variation
  return lobeVariance(lobe_cutoff.x);                    //? else
}

// The lobe over the footprint of a pixel.
SlopeLobe footprintLobe(Footprints f, FilteredSlopes s) { return slopeLobe(s.mean, s.spread, addedVariance(f)); }
