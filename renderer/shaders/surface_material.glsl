// Constants of a material: factors, the lobe or lobes, and texture coordinate transforms.
//? if multi_lobe
struct FacetLobe {
  vec3 axis;  // z is the facet's normal
  float parameter;
  float weight;
  float variance;  // slope variance per axis
};
//? end
layout(std140, binding = 0) uniform MaterialBlock {
  vec4 base_color_factor;
  vec4 dielectric_specular_metallic;
  vec4 lobe_cutoff;    // lobe parameter, alpha cutoff, 1 if unlit, squared strength of anisotropy
  vec4 uv_linear[4];   // slots normal, roughness, base_color, layer: columns d/du, d/dv
  vec4 uv_offset_set[4];  // w: see anisotropy()
//? if specular_variation
  vec4 specular_uv_linear;
  vec4 specular_uv_offset_set;
//? end
//? if clear_coat
  vec4 coat_weight_width;  // weight, alpha squared
  vec4 coat_uv_linear[3];  // slots weight, width, normal
  vec4 coat_uv_offset_set[3];
//? end
//? if material_index
  vec4 share_uv_linear;
  vec4 share_uv_offset_set;  // w: 1 for the first material of a surface, 0 for those that add to it
//? end
//? if emission
  vec4 emitted;  // radiance
//? end
//? if emission_variation
  vec4 emission_uv_linear;
  vec4 emission_uv_offset_set;
//? end
//? if occlusion
  vec4 occlusion_uv_linear;
  vec4 occlusion_uv_offset_set;
//? end
//? if multi_lobe
  int facet_lobe_count;  // 0: one lobe about the normal
  FacetLobe facet_lobes[most_facet_lobes];
//? end
};
//? if anisotropic_lobe
// Alpha along and across the direction of anisotropy, and that direction in the facet's tangent plane.
vec4 anisotropy() { return vec4(uv_offset_set[0].w, uv_offset_set[1].w, uv_offset_set[2].w, uv_offset_set[3].w); }
//? end
