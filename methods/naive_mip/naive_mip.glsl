// The mean normal, renormalised, with the mean roughness: one lobe, as wide as a facet's own.
struct Effective {
  vec3 normal;
  float lobe;
};

Effective effective(Footprints f) {
  Effective e;
//? if normal_variation
  vec3 mean = fetch(naive_normal, f.normal).xyz;
//? if storage_unorm8
  mean = 2.0 * mean - 1.0;
//? end
  float size = length(mean);
  e.normal = size > 1e-6 ? mean / size : vec3(0.0, 0.0, 1.0);
//? else
  e.normal = vec3(0.0, 0.0, 1.0);
//? end
//? if roughness_variation
  e.lobe = lobeFromRoughness(fetch(naive_roughness, f.roughness).r);
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

//? if environment_light
//? include one_lobe.glsl

vec3 meanNormal(Effective e) { return e.normal; }
//? end
