// The base BRDF itself: what the reference averages, and `direct` shades once a pixel.
//? if normal_layers
//? include normal_layers.glsl
//? end
struct Effective {
  vec3 normal;
  float lobe;
};

Effective effective(Footprints f) {
  Effective e;
//? if normal_variation
  vec4 texel = fetchFinest(base_normal, f.normal);
//? if not sampling_frame
  if (texel.w < 0.5) discard;  // an invalid normal of the map: nothing is there to shade
//? end
  e.normal = normalize(texel.xyz);
//? else
  e.normal = vec3(0.0, 0.0, 1.0);
//? end
//? if normal_layers
  vec4 layer = fetchFinest(base_layer, f.layer);
//? if not sampling_frame
  if (layer.w < 0.5) discard;
//? end
  e.normal = withSlopesAdded(e.normal, layer.xyz);
//? end
//? if roughness_variation
  e.lobe = lobeFromRoughness(fetchFinest(base_roughness, f.roughness).r);
//? else
  e.lobe = lobe_cutoff.x;
//? end
  return e;
}

vec3 specular(Effective e, vec3 f0, vec3 wi, vec3 wo) { return lobeSpecular(e.lobe, e.normal, f0, wi, wo); }

//? if diffuse
vec3 diffuse(Effective e, vec3 albedo, vec3 f0, vec3 wi, vec3 wo) { return lambert(e.normal, albedo, f0, wi, wo); }
//? end

float ndf(Effective e, vec3 h) { return lobeDensity(e.lobe, e.normal, h); }
