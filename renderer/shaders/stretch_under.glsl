// The stretch of the facets under a footprint, for anisotropic_facets.glsl: filtered as roughness is.
vec2 stretchUnder(Footprints f) {
  return fetchFinest(stretch_map, f.roughness).xy;  //? if finest_maps
  return fetch(stretch_map, f.roughness).xy;        //? else
}
