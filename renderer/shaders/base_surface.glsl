// The base BRDF itself: what the reference averages, and `direct` shades once a pixel.
//? include facets_module.glsl

Effective effective(Footprints f) {
//? if normal_variation
  vec4 texel = fetchFinest(base_normal, f.normal);
//? if not sampling_frame
  if (texel.w < 0.5) discard;  // an invalid normal of the map: nothing is there to shade
//? end
  vec3 normal = normalize(texel.xyz);
//? else
  vec3 normal = vec3(0.0, 0.0, 1.0);
//? end
//? if roughness_variation
  float lobe = lobeFromRoughness(fetchFinest(base_roughness, f.roughness).r);
//? else
  float lobe = lobe_cutoff.x;
//? end
  return Effective(evenFacets(normal, lobe));
}
