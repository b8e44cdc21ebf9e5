// One lobe about the mean normal, as wide as a facet's own and the expected spread together. Slope variances of
// independent spreads add.
struct Effective {
  vec3 normal;
  float lobe;
};

Effective effective(Footprints f) {
  Effective e;
//? if normal_variation
  vec4 texel = fetch(template_normal, f.normal);  // mean normal, spread
  float size = length(texel.xyz);
  e.normal = size > 1e-6 ? texel.xyz / size : vec3(0.0, 0.0, 1.0);
  e.lobe = lobeFromVariance(lobeVariance(template_lobe) + option_share * texel.w);
//? else
  e.normal = vec3(0.0, 0.0, 1.0);
  e.lobe = template_lobe;
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
