// Weight, mean and covariance of each part of the normals under a footprint, from moments that the texture filter may
// average, and one stretched base lobe a part (methods/cells/README.md).
//? include lobe_variance.glsl
//? if coordinates_slopes
//? include slope_part.glsl
//? else
//? include stereographic_part.glsl
//? end

//? if normal_variation
const int parts = int(option_k);
//? else
const int parts = 1;
//? end

struct Effective {
  Part part[parts];
  vec3 mean_normal;  // not renormalised: its dot product is the mean of the texels' own
};

// Moments of a part about its centre, w the weight: w, w dx, w dy, w dx^2, w dx dy, w dy^2.
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
vec2 centreOf(int i) {
  vec2 centres[8] = vec2[8](vec2(cells_centre_x0, cells_centre_y0), vec2(cells_centre_x1, cells_centre_y1),
                            vec2(cells_centre_x2, cells_centre_y2), vec2(cells_centre_x3, cells_centre_y3),
                            vec2(cells_centre_x4, cells_centre_y4), vec2(cells_centre_x5, cells_centre_y5),
                            vec2(cells_centre_x6, cells_centre_y6), vec2(cells_centre_x7, cells_centre_y7));
  return centres[i];
}

void setPart(inout Effective e, int i, float covered, Moments m, BaseLobe base) {
  if (m.first.x < least_share * covered) {
    e.part[i] = absentPart();
    return;
  }
  vec2 mean = m.first.yz / m.first.x;
  vec3 spread = covarianceOf(mean, m.second / m.first.x);
  e.part[i] = stretchedPart(m.first.x / covered, centreOf(i) + mean, spread, base.parameter, base.variance);
}

// The base lobe over a part: where the roughness map lies on the normals, the mean of the part's own texels.
BaseLobe lobeOfPart(BaseLobe shared_lobe, float weight, float weighted_variance) {
//? if roughness_variation and roughness_joint
  if (cells_joint > 0.5 && weight > 0.0) {
    float variance = weighted_variance / weight * stored_lobe_variance;
    return BaseLobe(lobeFromVariance(variance), variance);
  }
//? end
  return shared_lobe;
}

void fillParts(inout Effective e, Footprints f) {
  Moments moments[parts];
  float covered = 0.0;  // the part of the footprint with valid normals
  for (int i = 0; i < parts; i += 2) {
    int layer = 3 * (i / 2);
    vec4 first = fetch(cells_moments, layer, f.normal);
    vec4 middle = fetch(cells_moments, layer + 1, f.normal);
    moments[i] = Moments(first.xyz, vec3(first.w, middle.xy));
    covered += first.x;
    if (i + 1 < parts) {
      vec4 last = fetch(cells_moments, layer + 2, f.normal);
      moments[i + 1] = Moments(vec3(middle.zw, last.x), last.yzw);
      covered += middle.z;
    }
  }
  BaseLobe base = baseLobe(f);
  if (covered <= 0.0) {
    moments[0] = Moments(vec3(1.0, -centreOf(0)), vec3(0.0));
    covered = 1.0;
  }
  for (int i = 0; i < parts; ++i) {
//? if roughness_variation and roughness_joint
    vec4 variances = fetch(cells_variance, i / 4, f.normal);
    setPart(e, i, covered, moments[i], lobeOfPart(base, moments[i].first.x, variances[i % 4]));
//? else
    setPart(e, i, covered, moments[i], base);
//? end
  }
}
//? end

Effective effective(Footprints f) {
  Effective e;
  e.mean_normal = vec3(0.0, 0.0, 1.0);
//? if normal_variation
  fillParts(e, f);
//? if diffuse
  e.mean_normal = fetch(cells_normal, f.normal).xyz;
//? end
//? else
  BaseLobe base = baseLobe(f);
  e.part[0] = stretchedPart(1.0, vec2(0.0), vec3(0.0), base.parameter, base.variance);
//? end
  return e;
}

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
