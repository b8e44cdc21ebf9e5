// Constants of a material: factors, the lobe or lobes, and texture coordinate transforms.
#if MULTI_LOBE
struct FacetLobe {
  vec3 axis;  // z is the facet's normal
  float parameter;
  float weight;
  float variance;  // slope variance per axis
};
#endif
layout(std140, binding = 0) uniform MaterialBlock {
  vec4 base_color_factor;
  vec4 dielectric_specular_metallic;
  vec4 lobe_cutoff;    // lobe parameter, alpha cutoff, 1 if unlit, squared strength of anisotropy
  vec4 uv_linear[4];   // slots normal, roughness, base_color, layer: columns d/du, d/dv
  vec4 uv_offset_set[4];  // w: see anisotropy()
#if SPECULAR_VARIATION
  vec4 specular_uv_linear;
  vec4 specular_uv_offset_set;
#endif
#if CLEAR_COAT
  vec4 coat_weight_width;  // weight, alpha squared
  vec4 coat_uv_linear[3];  // slots weight, width, normal
  vec4 coat_uv_offset_set[3];
#endif
#if MATERIAL_INDEX
  vec4 share_uv_linear;
  vec4 share_uv_offset_set;  // w: 1 for the first material of a surface, 0 for those that add to it
#endif
#if EMISSION
  vec4 emitted;  // radiance
#endif
#if EMISSION_VARIATION
  vec4 emission_uv_linear;
  vec4 emission_uv_offset_set;
#endif
#if OCCLUSION
  vec4 occlusion_uv_linear;
  vec4 occlusion_uv_offset_set;
#endif
#if MULTI_LOBE
  int facet_lobe_count;  // 0: one lobe about the normal
  FacetLobe facet_lobes[most_facet_lobes];
#endif
};
#if ANISOTROPIC_LOBE
// Alpha along and across the direction of anisotropy, and that direction in the facet's tangent plane.
vec4 anisotropy() { return vec4(uv_offset_set[0].w, uv_offset_set[1].w, uv_offset_set[2].w, uv_offset_set[3].w); }
#endif
