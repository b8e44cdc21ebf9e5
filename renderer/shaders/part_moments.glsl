// The moments of parts of the normals under a footprint, from array textures that filters may average, and the lobe of
// a facet. Includers define `const int parts` and `const int part_channels`: 6, or 5 without the mixed second moment.
#include "lobe_variance.glsl"

// A part of weight w: w, w x, w y; w x^2, w x y (0 if not stored), w y^2.
struct Moments {
  vec3 first;
  vec3 second;
};

// Parts with a smaller share are skipped, which also avoids division by zero.
const float least_share = 1e-4;

// Covariance (xx, xy, yy) without a negative eigenvalue, which rounding can cause.
vec3 covarianceOf(vec2 mean, vec3 second) {
  vec3 c = second - vec3(mean.x * mean.x, mean.x * mean.y, mean.y * mean.y);
  vec2 diagonal = max(c.xz, 0.0);
  float most = sqrt(diagonal.x * diagonal.y);
  return vec3(diagonal.x, clamp(c.y, -most, most), diagonal.y);
}

// The parameter of the lobe of a facet and its slope variance per axis.
struct BaseLobe {
  float parameter;
  float variance;
};

BaseLobe baseLobe(Footprints f) {
#if ROUGHNESS_VARIATION
  float variance = baseVariance(f);
  return BaseLobe(lobeFromVariance(variance), variance);
#else
  return BaseLobe(lobe_cutoff.x, lobeVariance(lobe_cutoff.x));
#endif
}

#if TEXTURE_ARRAYS
const int fetched_layers = (parts * part_channels + 3) / 4;
#include "fetch_layers.glsl"

// The moments of all parts, from levels up to `coarsest`, and the share of the footprint that has valid normals.
float fetchMoments(sampler2DArray map, Footprint f, float coarsest, out Moments moments[parts]) {
  vec4 layers[fetched_layers];
  fetchLayers(map, f, coarsest, layers);
  float covered = 0.0;
  for (int i = 0; i < parts; ++i) {
    float own[part_channels];
    for (int j = 0; j < part_channels; ++j) own[j] = layers[(i * part_channels + j) / 4][(i * part_channels + j) % 4];
    moments[i].first = vec3(own[0], own[1], own[2]);
    moments[i].second = vec3(own[3], part_channels > 5 ? own[4] : 0.0, own[part_channels - 1]);
    covered += moments[i].first.x;
  }
  return covered;
}

float fetchMoments(sampler2DArray map, Footprint f, out Moments moments[parts]) {
  return fetchMoments(map, f, any_level, moments);
}
#endif

#if LOBES_LISTED
#if ANISOTROPIC_LOBE
const int lobes_per_part = row_count;
#else
const int lobes_per_part = 1;
#endif

// Lobe k of those that stand for a part under an environment: a row, or one round lobe of the same mean slope variance.
NormalLobe partLobe(Part part, int k) {
#if ANISOTROPIC_LOBE
  NormalLobe lobe = lobeOfWidths(part.widths, part.axis, k, part.share);
#else
  NormalLobe lobe = baseNormalLobe(part.axis, lobeFromVariance(part.breadth), part.share);
#endif
  lobe.base = part.lobe;
  return lobe;
}
#endif
