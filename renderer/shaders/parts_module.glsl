// A module whose pixel is some parts of the normals under a footprint, each with a share, mean and covariance, and a
// stretched base lobe. Who takes it in has `const int parts`, `Part` and what goes with it (stretched_part.glsl); what is
// missing is `effective`.
//? include lobe_variance.glsl

struct Effective {
  Part part[parts];
  vec3 mean_normal;  // not renormalised: its dot product is the mean of the texels' own
};

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
void fetchPair(sampler2DArray map, Footprint f, int i, inout Moments moments[parts], inout float covered) {
  int layer = 3 * (i / 2);
  vec4 first = fetch(map, layer, f);
  vec4 middle = fetch(map, layer + 1, f);
  moments[i] = Moments(first.xyz, vec3(first.w, middle.xy));
  covered += first.x;
  if (i + 1 < parts) {
    vec4 last = fetch(map, layer + 2, f);
    moments[i + 1] = Moments(vec3(middle.zw, last.x), last.yzw);
    covered += middle.z;
  }
}

// The moments of all parts, and what they cover of the footprint: the part of it with valid normals.
float fetchMoments(sampler2DArray map, Footprint f, out Moments moments[parts]) {
  float covered = 0.0;
  fetchPair(map, f, 0, moments, covered);
  if (parts > 2) fetchPair(map, f, 2, moments, covered);
  if (parts > 4) fetchPair(map, f, 4, moments, covered);
  if (parts > 6) fetchPair(map, f, 6, moments, covered);
  return covered;
}
//? end

float ndf(Effective e, vec3 h) {
  Direction at = directionOf(h);
  float sum = 0.0;
  for (int i = 0; i < parts; ++i) sum += partDensity(e.part[i], at);
  return sum;
}

// The geometry is that of single facets about the part's mean.
Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo) {
  Reflected r;
  r.specular = vec3(0.0);
  if (halfVectorIsDefined(wi, wo)) {
    vec3 h = halfVector(wi, wo);
    Direction at = directionOf(h);
    float sum = 0.0;
    for (int i = 0; i < parts; ++i)
      sum += partDensity(e.part[i], at) * geometryFactor(e.part[i].lobe, e.part[i].axis, h, wi, wo);
    r.specular = fresnelTerm(s.f0, wi, wo) * sum;
  }
//? if diffuse
  r.diffuse = diffuse(e.mean_normal, s, wi, wo);
//? end
  return r;
}

//? if environment_light
int lobeCount(Effective e) { return parts; }

// A round lobe of the same mean slope variance.
NormalLobe normalLobe(Effective e, int i) {
  NormalLobe lobe = baseNormalLobe(e.part[i].axis, lobeFromVariance(e.part[i].breadth), e.part[i].share);
  lobe.base = e.part[i].lobe;
  return lobe;
}

float lobeGeometry(Effective e, NormalLobe lobe, vec3 h, vec3 wi, vec3 wo) {
  return geometryFactor(lobe.base, lobe.axis, h, wi, wo);
}

vec3 meanNormal(Effective e) { return e.mean_normal; }
//? end
