// Weight, mean and covariance of each part of the normals under a footprint, from moments that the texture filter may
// average, and one stretched base lobe per part (methods/cells/README.md).
#if DENSITY_FAST
const bool fast_density = true;
#else
const bool fast_density = false;
#endif
#if COORDINATES_SLOPES
#include "slope_part.glsl"
#else
#include "stretched_part.glsl"
#endif

#if TEXTURE_ARRAYS
const int parts = int(option_k);
#else
const int parts = 1;
#endif
#if COVARIANCE_AXES
const int part_channels = 5;
#else
const int part_channels = 6;
#endif

#include "parts_module.glsl"

#if SPECULAR_JOINT && SPECULAR_VARIATION
vec3 tint[parts];  // specular colour of each part over that of the footprint, per unit of the share

vec3 partsSpecular(Effective e, Surface s, vec3 h, vec3 wi, vec3 wo) {
  Direction at = directionOf(h);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < parts; ++i)
    sum += partReflectance(e.part[i], at, h, wi, wo) * fresnelTerm(s.f0 * tint[i], wi, wo);
  return sum;
}
#else
#include "even_parts.glsl"
#endif

#if TEXTURE_ARRAYS
#if COVARIANCE_AXES
// From the part's own axes to the plane's.
vec2 meanOf(int i, vec2 own) {
  vec2 a = cells_axes[i];
  return cells_centres[i] + own.x * a + own.y * vec2(-a.y, a.x);
}
vec3 spreadOf(int i, vec2 own_mean, vec3 second) {
  vec2 a = cells_axes[i];
  vec2 own = max(second.xz - own_mean * own_mean, 0.0);
  return vec3(own.x * a.x * a.x + own.y * a.y * a.y, (own.x - own.y) * a.x * a.y, own.x * a.y * a.y + own.y * a.x * a.x);
}
#else
vec2 meanOf(int i, vec2 own) { return cells_centres[i] + own; }
vec3 spreadOf(int i, vec2 own_mean, vec3 second) { return covarianceOf(own_mean, second); }
#endif

// A part that covers less than `least_share` is not there; it is worked out like the others, without a branch.
void setPart(inout Effective e, int i, float covered, Moments m, BaseLobe base) {
  float least = least_share * covered;
  float per_weight = 1.0 / max(m.first.x, least);
  vec2 own_mean = m.first.yz * per_weight;
  vec2 mean = meanOf(i, own_mean);
  vec3 spread = spreadOf(i, own_mean, m.second * per_weight);
  float share = m.first.x < least ? 0.0 : m.first.x / covered;
  e.part[i] = stretchedPart(share, mean, spread, base.parameter, base.variance);
#if DIFFUSE && !(COORDINATES_SLOPES || (SPECULAR_JOINT && SPECULAR_VARIATION))
  e.mean_normal += share * meanNormalOf(mean, spread);
#endif
}

// That of the smallest alpha of a material, 0.001. In 16 bits the weighted variance of a small part of polished facets
// rounds to 0, as that of a part that is not there is, and no lobe has that.
const float least_variance = 5e-7;

// The base lobe over a part: if the roughness map has the same texels as the normals, the mean of the part's own texels.
BaseLobe lobeOfPart(BaseLobe shared_lobe, float weight, float weighted_variance) {
#if ROUGHNESS_VARIATION && ROUGHNESS_JOINT
  if (cells_joint > 0.5) {
    float variance = max(weighted_variance / max(weight, 1e-12) * stored_lobe_variance, least_variance);
    return BaseLobe(lobeFromVariance(variance), variance);
  }
#endif
  return shared_lobe;
}

#if SPECULAR_JOINT && SPECULAR_VARIATION
// A part's specular colour over that of the footprint, both per unit of their weight. Where the sum of a channel is 0,
// so is that of the footprint, or no normal is valid.
void setTints(Footprints f, Moments moments[parts]) {
  const int per_channel = (parts + 3) / 4;
  vec4 layers[3 * per_channel];
  for (int l = 0; l < 3 * per_channel; ++l) layers[l] = fetch(cells_colours, l, f.normal);
  vec3 colours = vec3(0.0);
  float weights = 0.0;
  for (int i = 0; i < parts; ++i) {
    for (int c = 0; c < 3; ++c) tint[i][c] = layers[c * per_channel + i / 4][i % 4];
    colours += tint[i];
    weights += moments[i].first.x;
  }
  for (int i = 0; i < parts; ++i) {
    float share = max(moments[i].first.x / weights, least_share);
    tint[i] = mix(vec3(1.0), tint[i] / (share * max(colours, 1e-20)), greaterThan(colours, vec3(0.0)));
  }
}
#endif

// The moments of a part that is the surface's own normal, where no texel has a valid one.
Moments flatMoments() {
  vec2 own = -cells_centres[0];
#if COVARIANCE_AXES
  vec2 a = cells_axes[0];
  own = vec2(dot(own, a), dot(own, vec2(-a.y, a.x)));
#endif
  return Moments(vec3(1.0, own), vec3(0.0));
}

void fillParts(inout Effective e, Footprints f) {
  Moments moments[parts];  // about the part's centre
  float covered = fetchMoments(cells_moments, f.normal, moments);
  BaseLobe base = baseLobe(f);
  if (covered <= 0.0) {
    moments[0] = flatMoments();
    covered = 1.0;
  }
#if ROUGHNESS_VARIATION && ROUGHNESS_JOINT
  vec4 variances[2] = vec4[2](fetch(cells_variance, 0, f.normal), vec4(0.0));
  if (parts > 4) variances[1] = fetch(cells_variance, 1, f.normal);
#endif
  for (int i = 0; i < parts; ++i) {
#if ROUGHNESS_VARIATION && ROUGHNESS_JOINT
    setPart(e, i, covered, moments[i], lobeOfPart(base, moments[i].first.x, variances[i / 4][i % 4]));
#else
    setPart(e, i, covered, moments[i], base);
#endif
  }
#if SPECULAR_JOINT && SPECULAR_VARIATION
  setTints(f, moments);
#endif
}
#endif

Effective effective(Footprints f) {
  Effective e;
#if TEXTURE_ARRAYS
#if DIFFUSE && !(COORDINATES_SLOPES || (SPECULAR_JOINT && SPECULAR_VARIATION))
  e.mean_normal = vec3(0.0);
  fillParts(e, f);
#else
  fillParts(e, f);
#if DIFFUSE && NORMAL_VARIATION
  e.mean_normal = fetch(cells_normal, f.normal).xyz;
#else
  e.mean_normal = vec3(0.0, 0.0, 1.0);
#endif
#endif
#else
  e.mean_normal = vec3(0.0, 0.0, 1.0);
  BaseLobe base = baseLobe(f);
  e.part[0] = stretchedPart(1.0, vec2(0.0), vec3(0.0), base.parameter, base.variance);
#if SPECULAR_JOINT && SPECULAR_VARIATION
  tint[0] = vec3(1.0);
#endif
#endif
  return e;
}
