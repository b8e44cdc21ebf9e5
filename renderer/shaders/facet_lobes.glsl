// Facets that reflect with several lobes, whose axes turn with the facet's normal (docs/base-brdf.md).

//? include facet_frame.glsl

// Lobe k over facets whose normals have a slope variance per axis of `spread`.
float widenedLobe(int k, float spread) {
  return spread > 0.0 ? lobeFromVariance(facet_lobes[k].variance + spread) : facet_lobes[k].parameter;
}
