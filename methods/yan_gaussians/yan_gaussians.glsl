// Gaussian elements, one a texel, summed under a Gaussian footprint. One sample of many is one texel's facet.
//? if normal_variation
// The footprint on the map as it is stored: one that does not repeat is followed by its mirror image.
Footprint folded(Footprint f) {
  vec2 share = vec2(yan_share_u, yan_share_v);
  f.uv = mix(f.uv, clamp(f.uv, 0.0, 1.0), vec2(yan_clamp_u, yan_clamp_v)) * share;
  f.dx *= share;
  f.dy *= share;
  return f;
}

//? end
//? include yan_element.glsl
//? if normal_variation and sampling_frame
//? include yan_sum.glsl
//? else
//? include yan_texel.glsl
//? end
