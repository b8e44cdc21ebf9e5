// Alpha of the finest level at a point, and the alpha test, for passes without footprints.
bool isCutOut() {
  float alpha = base_color_factor.a;
#if BASE_COLOR_VARIATION
  vec2 uv = uv_offset_set[2].z < 0.5 ? uv0 : uv1;
  alpha *= textureLod(base_color_map, mat2(uv_linear[2].xy, uv_linear[2].zw) * uv + uv_offset_set[2].xy, 0.0).a;
#endif
#if VERTEX_COLOR
  alpha *= vertex_alpha;
#endif
  return alpha < lobe_cutoff.y;
}
