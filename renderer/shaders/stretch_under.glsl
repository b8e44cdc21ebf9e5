// The stretch of the facets under a footprint, for anisotropic_facets.glsl: filtered as roughness is.
vec2 stretchUnder(Footprints f) {
#if FINEST_MAPS
  return fetchFinest(stretch_map, f.roughness).xy;
#else
  return fetch(stretch_map, f.roughness).xy;
#endif
}
