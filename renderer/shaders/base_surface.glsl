// The base BRDF itself: what the reference averages, and `direct` shades once a pixel.
//? if microgeometry_visibility
//? include patch_facets.glsl
//? end

struct Effective {
  Facets facets;
//? if microgeometry_visibility
  FacetDraw draw;
//? end
};

Facets texelFacets(Footprints f) {
//? if normal_variation
  vec4 texel = fetchFinest(base_normal, f.normal);
//? if not sampling_frame
//? if microgeometry_visibility
  if (texel.w < 0.5 && base_has_patch < 0.5) discard;
//? else
  if (texel.w < 0.5) discard;  // an invalid normal of the map: nothing is there to shade
//? end
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
  return evenFacets(normal, lobe);
}

Effective effective(Footprints f) {
  Effective e;
  e.facets = texelFacets(f);
//? if microgeometry_visibility
//? if sample_draws
  e.draw = FacetDraw(texel_draw);
//? else
  e.draw = FacetDraw(vec2(0.5));
//? end
//? end
  return e;
}

vec3 specular(Effective e, vec3 f0, vec3 wi, vec3 wo) {
//? if microgeometry_visibility
  if (base_has_patch > 0.5) return patchSpecular(e.draw, f0, wi, wo);
//? end
  return facetSpecular(e.facets, f0, wi, wo);
}

//? if diffuse
vec3 diffuse(Effective e, vec3 albedo, vec3 f0, vec3 wi, vec3 wo) {
//? if microgeometry_visibility
  if (base_has_patch > 0.5) return patchDiffuse(e.draw, albedo, f0, wi, wo);
//? end
  return lambert(e.facets.normal, albedo, f0, wi, wo);
}
//? end

float ndf(Effective e, vec3 h) { return facetDensity(e.facets, h); }
