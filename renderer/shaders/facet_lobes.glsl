// Facets with several lobes whose axes rotate with the normal of the facet (docs/explanation/base-brdf.md).

//? include facet_frame.glsl

// Lobe k over facets with a slope variance per axis of `spread`.
float widenedLobe(int k, float spread) {
  return spread > 0.0 ? lobeFromVariance(facet_lobes[k].variance + spread) : facet_lobes[k].parameter;
}
