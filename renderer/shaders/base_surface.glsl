// The base BRDF of a texel. The reference averages it over its samples.
//? include normal_layers.glsl if normal_layers
//? include patch_facets.glsl if microgeometry_visibility
//? include facets_module.glsl if not microgeometry_visibility

Effective effective(Footprints f) {
//? if normal_variation
  vec4 texel = fetchFinest(base_normal, f.normal);
//? if not sampling_frame and microgeometry_visibility
  nothing_to_shade = texel.w < 0.5 && base_has_patch < 0.5;
//? elif not sampling_frame
  nothing_to_shade = texel.w < 0.5;  // an invalid normal of the map: the surface is there, what it reflects is not known
//? end
  vec3 normal = normalize(texel.xyz);
//? else
  vec3 normal = vec3(0.0, 0.0, 1.0);
//? end
//? if normal_layers
  vec4 layer = fetchFinest(base_layer, f.layer);
  if (layer.w < 0.5) nothing_to_shade = true;  //? if not sampling_frame
  normal = withSlopesAdded(normal, layer.xyz);
//? end
  float lobe = lobeFromRoughness(fetchFinest(base_roughness, f.roughness).r);  //? if roughness_variation
  float lobe = lobe_cutoff.x;                                                  //? else
  return Effective(evenFacets(normal, lobe), drawnFacets());  //? if microgeometry_visibility
  return Effective(evenFacets(normal, lobe));                 //? else
}

//? if directions_drawn
//? include lobe_sampling.glsl

// A direction about n with cosine density.
vec3 lambertDirection(vec3 n, vec2 u) {
  float azimuth = 2.0 * pi * u.y;
  return frameAbout(n) * vec3(sqrt(u.x) * vec2(cos(azimuth), sin(azimuth)), sqrt(1.0 - u.x));
}

// Draws a direction to the light: the mirror image of wo about a normal drawn from the facets. With a diffuse term,
// half of the draws use the cosine density instead. Zero if there is none.
vec3 drawDirection(Effective e, vec3 wo, vec3 u) {
//? if microgeometry_visibility
  if (base_has_patch > 0.5) return lambertDirection(vec3(0.0, 0.0, 1.0), u.xy);  // facets point everywhere
//? end
//? if diffuse
  if (u.z < 0.5) return lambertDirection(e.facets.normal, u.xy);
  u.z = 2.0 * u.z - 1.0;
//? end
  vec3 h = drawnFacet(e.facets, u);
  float cosine = dot(h, wo);
  return cosine > 0.0 ? 2.0 * cosine * h - wo : vec3(0.0);
}

// The density of that direction over solid angle.
float directionDensity(Effective e, vec3 wi, vec3 wo) {
  if (base_has_patch > 0.5) return max(wi.z, 0.0) / pi;  //? if microgeometry_visibility
  if (!halfVectorIsDefined(wi, wo)) return 0.0;
  vec3 h = halfVector(wi, wo);
  float density = drawnFacetDensity(e.facets, h) / (4.0 * max(dot(h, wo), 1e-6));
  density = 0.5 * density + 0.5 * max(dot(e.facets.normal, wi), 0.0) / pi;  //? if diffuse
  return density;
}
//? end
