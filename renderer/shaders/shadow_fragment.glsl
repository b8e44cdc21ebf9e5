// What a shadow map keeps: linear depth along its axis, of what no alpha mask cuts out.
in float depth;
//? if alpha_mask
in vec2 uv0;
in vec2 uv1;
//? if vertex_color
in float vertex_alpha;
//? end
//? end

void main() {
//? if alpha_mask
  float alpha = base_color_factor.a;
//? if base_color_variation
  vec2 uv = uv_offset_set[2].z < 0.5 ? uv0 : uv1;
  alpha *= textureLod(base_color_map, mat2(uv_linear[2].xy, uv_linear[2].zw) * uv + uv_offset_set[2].xy, 0.0).a;
//? end
//? if vertex_color
  alpha *= vertex_alpha;
//? end
  if (alpha < lobe_cutoff.y) discard;
//? end
  gl_FragDepth = depth;
}
