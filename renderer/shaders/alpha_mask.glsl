// Alpha of the finest level at a point, and the alpha test, for passes without footprints.
bool isCutOut() {
  float alpha = base_color_factor.a;
//? if base_color_variation
  vec2 uv = uv_offset_set[2].z < 0.5 ? uv0 : uv1;
  alpha *= textureLod(base_color_map, mat2(uv_linear[2].xy, uv_linear[2].zw) * uv + uv_offset_set[2].xy, 0.0).a;
//? end
  alpha *= vertex_alpha;  //? if vertex_color
  return alpha < lobe_cutoff.y;
}
