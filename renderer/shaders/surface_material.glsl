// What is constant over a material: factors, the lobe, and where each map is looked up.
layout(std140, binding = 0) uniform MaterialBlock {
  vec4 base_color_factor;
  vec4 dielectric_specular_metallic;
  vec4 lobe_cutoff;    // lobe parameter, alpha cutoff
  vec4 uv_linear[3];   // slots normal, roughness, base_color: columns d/du, d/dv
  vec4 uv_offset_set[3];
//? if normal_layers
  vec4 layer_uv_linear;
  vec4 layer_uv_offset_set;
//? end
};
