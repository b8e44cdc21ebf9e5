// The moments of some parts of the normals under a footprint, from array textures that the filter may average, and a
// facet's lobe. Who takes it in has `const int parts`.
//? include lobe_variance.glsl

// Of a part of weight w: w, w x, w y, w x^2, w x y, w y^2.
struct Moments {
  vec3 first;
  vec3 second;
};

// Under this share of the footprint a part is left out, and no division is by nothing.
const float least_share = 1e-4;

// Covariance (xx, xy, yy) without a negative eigenvalue, which rounding makes where normals agree.
vec3 covarianceOf(vec2 mean, vec3 second) {
  vec3 c = second - vec3(mean.x * mean.x, mean.x * mean.y, mean.y * mean.y);
  vec2 diagonal = max(c.xz, 0.0);
  float most = sqrt(diagonal.x * diagonal.y);
  return vec3(diagonal.x, clamp(c.y, -most, most), diagonal.y);
}

// The parameter and the slope variance per axis of a facet's lobe.
struct BaseLobe {
  float parameter;
  float variance;
};

BaseLobe baseLobe(Footprints f) {
//? if roughness_variation
  float variance = baseVariance(f);
  return BaseLobe(lobeFromVariance(variance), variance);
//? else
  return BaseLobe(lobe_cutoff.x, lobeVariance(lobe_cutoff.x));
//? end
}

//? if normal_variation
// Parts i and i + 1, from three layers. It is called for each pair by itself: a loop over fetches, which are loops
// themselves, is not unrolled, and arrays that it writes cost llvmpipe more than the fetches.
void fetchPair(sampler2DArray map, Footprint f, float coarsest, int i, inout Moments moments[parts],
               inout float covered) {
  int layer = 3 * (i / 2);
  vec4 first = fetchUpTo(map, layer, f, coarsest);
  vec4 middle = fetchUpTo(map, layer + 1, f, coarsest);
  moments[i] = Moments(first.xyz, vec3(first.w, middle.xy));
  covered += first.x;
  if (i + 1 < parts) {
    vec4 last = fetchUpTo(map, layer + 2, f, coarsest);
    moments[i + 1] = Moments(vec3(middle.zw, last.x), last.yzw);
    covered += middle.z;
  }
}

// The moments of all parts, from no level above `coarsest`, and what they cover of the footprint: the part of it with
// valid normals.
float fetchMoments(sampler2DArray map, Footprint f, float coarsest, out Moments moments[parts]) {
  float covered = 0.0;
  fetchPair(map, f, coarsest, 0, moments, covered);
  if (parts > 2) fetchPair(map, f, coarsest, 2, moments, covered);
  if (parts > 4) fetchPair(map, f, coarsest, 4, moments, covered);
  if (parts > 6) fetchPair(map, f, coarsest, 6, moments, covered);
  return covered;
}

float fetchMoments(sampler2DArray map, Footprint f, out Moments moments[parts]) {
  return fetchMoments(map, f, any_level, moments);
}
//? end
