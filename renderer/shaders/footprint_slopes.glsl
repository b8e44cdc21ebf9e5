// The slopes under a pixel's footprint: the lobe of common_slopes.glsl from the textures of `bake_slopes`
// (renderer/bake/slope_moments.hpp), a bump layer's added.
//? include common_slopes.glsl
//? if not normal_variation or not roughness_moments
//? include lobe_variance.glsl
//? end

// The base lobe's slope variance, but for what the moments hold already.
float addedVariance(Footprints f) {
//? if normal_variation and roughness_moments
  return 0.0;
//? else
  return baseVariance(f);
//? end
}

// The lobe over a pixel's footprint.
SlopeLobe footprintLobe(Footprints f) {
  vec2 mean = vec2(0.0);
  mat2 spread = mat2(0.0);
//? if normal_variation
  vec4 moments = fetch(slope_moments, f.normal);
  mean = moments.xy;
//? if variant_clean
  spread = mat2(scalarCovariance(mean, moments.z));
//? else
  spread = slopeCovariance(mean, vec3(moments.z, fetch(slope_cross, f.normal).r, moments.w));
//? end
//? end
//? if normal_layers
  // Slopes of independent layers add, and so do their means and covariances: M = M1 + M2 + B1 B2^T + B2 B1^T less
  // (B1 + B2)(B1 + B2)^T is (M1 - B1 B1^T) + (M2 - B2 B2^T), in the order that cancels least.
  vec4 layer = fetch(layer_moments, f.layer);
//? if variant_clean
  spread += mat2(scalarCovariance(layer.xy, layer.z));
//? else
  spread += slopeCovariance(layer.xy, vec3(layer.z, fetch(layer_cross, f.layer).r, layer.w));
//? end
  mean += layer.xy;
//? end
  return slopeLobe(mean, spread, addedVariance(f));
}
