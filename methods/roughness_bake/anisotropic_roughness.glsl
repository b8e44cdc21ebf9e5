// One lobe with two widths as KHR_materials_anisotropy draws it, from the texture of roughness_bake.hpp.
#include "mean_normal.glsl"
#include "anisotropic_widths.glsl"

struct Effective {
  vec3 normal;
  float round_lobe;  // with the mean slope variance of both widths
  vec2 alphas;       // along and across
  vec2 direction;    // in the tangent plane
};

Effective effective(Footprints f) {
  vec4 stored = fetch(anisotropic_roughness, f.normal);
  vec2 direction = 2.0 * stored.xy - 1.0;
  float size = length(direction);
  float across = max(stored.w * stored.w, smallest_alpha);
  vec2 alphas = vec2(mix(across, 1.0, stored.z * stored.z), across);
  return Effective(meanNormal(f).xyz, lobeFromVariance(0.25 * dot(alphas, alphas)), alphas,
                   size > 1e-6 ? direction / size : vec2(1.0, 0.0));
}

mat2 squaredAlphas(Effective e) { return inAxes(e.alphas.x * e.alphas.x, e.alphas.y * e.alphas.y, e.direction); }

float ndf(Effective e, vec3 h) { return stretchedDensity(e.alphas, e.direction, e.normal, h); }

float factor(Effective e, vec3 h, vec3 wi, vec3 wo) {
  return stretchedGeometry(squaredAlphas(e), e.round_lobe, e.normal, h, wi, wo);
}

float reflectedDensity(Effective e, vec3 h, vec3 wi, vec3 wo) { return ndf(e, h) * factor(e, h, wi, wo); }

vec3 meanNormal(Effective e) { return e.normal; }

#include "density_module.glsl"

#if LOBES_LISTED
#include "lobe_row.glsl"
int lobeCount(Effective e) { return row_count; }

NormalLobe normalLobe(Effective e, int i) { return lobeOfWidths(squaredAlphas(e), e.normal, i, 1.0); }

float lobeGeometry(Effective e, NormalLobe lobe, vec3 h, vec3 wi, vec3 wo) { return factor(e, h, wi, wo); }
#endif
