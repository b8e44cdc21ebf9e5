// The material as uniforms of a module: replaces surface_material.glsl in programs of others.
uniform vec4 lobe_cutoff;  // x: the base lobe's parameter, where it does not vary; w: squared strength of anisotropy
#if ANISOTROPIC_LOBE
uniform vec4 lobe_anisotropy;  // alpha along and across its direction, the direction in the facet's tangent plane
vec4 anisotropy() { return lobe_anisotropy; }
#endif
#if MULTI_LOBE
struct FacetLobe {
  vec3 axis;  // z is the facet's normal
  float parameter;
  float weight;
  float variance;  // slope variance per axis
};
uniform int facet_lobe_count;  // 0: one lobe about the normal
uniform FacetLobe facet_lobes[most_facet_lobes];
#endif
