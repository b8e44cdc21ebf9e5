// Tan et al. 2005, "Multiresolution Reflectance Filtering": the normals under a footprint are a mixture of isotropic
// Gaussians over the unit disc of (n_x, n_y). The weight, mean and second moment of a component are linear in its
// samples, so that the texture filter can blend them. Mean and variance are recovered after the filter (section 4.2).
#include "facet_variance.glsl"
#if COVARIANCE_FULL
#include "full_mixture.glsl"
#else

#if NORMAL_VARIATION
const int components = int(option_n);
const int fetched_layers = components;
#include "fetch_layers.glsl"
#else
const int components = 1;
#endif

// Components. lobe=gaussian: `amount` is the share of the energy over the norm of the density, and `width` the variance
// per axis of the disc, of normals and base lobe together. lobe=base: `amount` is the share, and `width` the parameter
// of the widened base lobe. Absent components have amount 0.
struct Effective {
  vec3 mean[components];
  float share[components];
  float amount[components];
  float width[components];
#if MULTI_LOBE
  float spread[components];  // of the normals only, in the unit of `width`; it widens each of the material's lobes
#endif
  float lobe;  // of a single facet
#if DIFFUSE && NORMAL_VARIATION && SPECULAR_JOINT && SPECULAR_VARIATION
  vec3 mean_normal;  // by area, because the colours weigh the components
#endif
};

// A Gaussian over the disc.
struct Component {
  float share;
  vec2 mean;
  float spread;  // variance per axis of the normals only
};

// Components that cover less than this share of the footprint are left out, which also avoids divisions by 0.
const float least_share = 1e-4;

Component recovered(vec4 filtered) {
  if (filtered.x < least_share) return Component(0.0, vec2(0.0), 0.0);
  vec2 mean = filtered.yz / filtered.x;
  float spread = max(filtered.w / filtered.x - dot(mean, mean), 0.0);  // rounding of the storage can make it negative
#if MOMENT_CORRECTED
  spread *= 0.5;  // the texture stores E |n|^2 = |mu|^2 + 2 sigma^2, over both axes
#endif
  return Component(filtered.x, mean, spread);
}

// The height of the hemisphere over a point of the disc.
float heightOver(vec2 mean) { return sqrt(max(1.0 - dot(mean, mean), 0.0)); }

#if LOBE_GAUSSIAN
// The base lobe's variance over the disc: smaller by the cosine, but on the rim its own width still reaches above.
float baseOverDisc(float variance, float height) {
#if FORESHORTEN_ON
  return variance * min(max(height, sqrt(variance)), 1.0);
#else
  return variance;
#endif
}

#include "vmf.glsl"

// The mass of a Gaussian inside the disc: a noncentral chi-squared distribution of 2 degrees of freedom, by Sankaran 1963.
float massInDisc(vec2 mean, float variance) {
  float distance = length(mean);
  if (1.0 - distance > 4.0 * sqrt(variance)) return 1.0;
  float lambda = dot(mean, mean) / variance;
  float sum = 2.0 + lambda;
  float h = 1.0 - (2.0 / 3.0) * sum * (2.0 + 3.0 * lambda) / ((sum + lambda) * (sum + lambda));
  float p = (sum + lambda) / (sum * sum);
  float m = (h - 1.0) * (1.0 - 3.0 * h);
  float centre = 1.0 + h * p * (h - 1.0 - 0.5 * (2.0 - h) * m * p);
  return normalCdf((pow(1.0 / (variance * sum), h) - centre) / (h * sqrt(2.0 * p) * (1.0 + 0.5 * m * p)));
}

// The visible share of a component's energy over the hemisphere, divided by the share of its Gaussian inside the disc.
// A lobe loses only the part below the horizon; the Gaussian loses far more beyond the disc.
float rimFactor(vec2 mean, float variance, float height, float base_variance) {
#if RIM_NORMALIZED
  return normalCdf(asin(height) * inversesqrt(base_variance)) / max(massInDisc(mean, variance), 1e-3);
#else
  return 1.0;
#endif
}

// The Gaussian over the disc of normals and base lobe together (Tan 2005, section 3): its variance, and its share of
// the energy over the norm of the density. `base`: the variance of the base lobe.
float widthOverDisc(float spread, float base, float height) {
  return clamp(spread + baseOverDisc(base, height), 1e-6, 4.0);
}
float amountOverDisc(float share, vec2 mean, float width, float height, float base) {
  return share * rimFactor(mean, width, height, base) / (2.0 * pi * width);
}

// The density over solid angle: an area of the disc is h_z times the solid angle above it.
float densityOverDisc(float amount, vec2 mean, float width, vec3 h) {
  countLobes(1);
  vec2 d = h.xy - mean;
  return amount * exp(-0.5 * dot(d, d) / width) * max(h.z, 0.0);
}

void setLobe(inout Effective e, int i, float share, vec2 mean, float height, float spread) {
  float base = clamp(lobeVariance(e.lobe), 1e-6, 4.0);
  e.width[i] = widthOverDisc(spread, base, height);
  e.amount[i] = amountOverDisc(share, mean, e.width[i], height, base);
#if MULTI_LOBE
  e.spread[i] = spread;
#endif
}

float lobeOverComponent(Effective e, int i, vec3 h) {
  return densityOverDisc(e.amount[i], e.mean[i].xy, e.width[i], h);
}

#if MULTI_LOBE
// Lobe k about its axis, turned with the mean, if that is over the disc. `own`: h in the frame of the mean.
float lobeOverComponent(Effective e, int i, int k, vec3 h, vec3 own) {
  vec3 axis = turnedWithNormal(facet_lobes[k].axis, e.mean[i]);
  if (axis.z <= 0.0 || e.amount[i] <= 0.0) return 0.0;
  float base = clamp(facet_lobes[k].variance, 1e-6, 4.0);
  float width = widthOverDisc(e.spread[i], base, axis.z);
  return densityOverDisc(amountOverDisc(e.share[i], axis.xy, width, axis.z, base), axis.xy, width, h);
}
#endif
#else
// The base lobe about the component's mean, widened by the component's spread. An area of the disc is the cosine times
// its solid angle, so the round lobe has the spread over the cosine or, on the rim, over its own width.
void setLobe(inout Effective e, int i, float share, vec2 mean, float height, float spread) {
  float around = spread <= 0.0 ? 0.0 : spread / max(height, sqrt(spread));
  e.width[i] = spread <= 0.0 ? e.lobe : lobeFromVariance(lobeVariance(e.lobe) + around);
  e.amount[i] = share * lobeEnergy(e.lobe) / lobeEnergy(e.width[i]);
#if MULTI_LOBE
  e.spread[i] = around;
#endif
}

float lobeOverComponent(Effective e, int i, vec3 h) {
  return e.amount[i] <= 0.0 ? 0.0 : e.amount[i] * lobeDensity(e.width[i], e.mean[i], h);
}

#if MULTI_LOBE
float lobeOverComponent(Effective e, int i, int k, vec3 h, vec3 own) {
  if (e.amount[i] <= 0.0) return 0.0;
  float widened = widenedLobe(k, e.spread[i]);
  float energy = lobeEnergy(facet_lobes[k].parameter) / lobeEnergy(widened);
  return e.share[i] * energy * lobeDensity(widened, facet_lobes[k].axis, own);
}
#endif
#endif

float componentDensity(Effective e, int i, vec3 h) {
#if MULTI_LOBE
  if (facet_lobe_count > 0) {
    vec3 own = inFacetFrame(h, e.mean[i]);
    float sum = 0.0;
    for (int k = 0; k < facet_lobe_count; ++k) sum += facet_lobes[k].weight * lobeOverComponent(e, i, k, h, own);
    return sum;
  }
#endif
  return lobeOverComponent(e, i, h);
}

// The geometry factor is that of single facets about the component's mean.
float componentReflectance(Effective e, int i, vec3 h, vec3 wi, vec3 wo) {
#if MULTI_LOBE
  if (facet_lobe_count > 0) {
    vec3 own = inFacetFrame(h, e.mean[i]);
    float sum = 0.0;
    for (int k = 0; k < facet_lobe_count; ++k) {
      sum += facet_lobes[k].weight * lobeOverComponent(e, i, k, h, own) *
             geometryFactor(facet_lobes[k].parameter, e.mean[i], h, wi, wo);
    }
    return sum;
  }
#endif
  return lobeOverComponent(e, i, h) * geometryFactor(e.lobe, e.mean[i], h, wi, wo);
}

float baseLobe(Footprints f) {
#if ROUGHNESS_VARIATION
  return lobeFromVariance(facetVariance(f));
#else
  return lobe_cutoff.x;
#endif
}

void setComponent(inout Effective e, int i, Component c) {
  float size = length(c.mean);
  vec2 mean = size > 1.0 ? c.mean / size : c.mean;  // after rounding
  float height = heightOver(mean);
  e.mean[i] = vec3(mean, height);
  e.share[i] = c.share;
  e.amount[i] = 0.0;
  e.width[i] = e.lobe;
#if MULTI_LOBE
  e.spread[i] = 0.0;
#endif
  if (c.share > 0.0) setLobe(e, i, c.share, mean, height, c.spread);
}

Effective effective(Footprints f) {
  Effective e;
  e.lobe = baseLobe(f);
#if NORMAL_VARIATION
  Component parts[components];
  vec4 layers[components];
  fetchLayers(tan_gmm_mixture, f.normal, any_level, layers);
#if SPECULAR_JOINT && SPECULAR_VARIATION
  // Components are left out by their share of the footprint, also of a dark one.
  float total = 0.0;
  for (int i = 0; i < components; ++i) total += layers[i].x;
  for (int i = 0; i < components; ++i) layers[i] /= max(total, 1e-6);
#if DIFFUSE
  e.mean_normal = fetch(tan_gmm_normal, f.normal).xyz;
#endif
#endif
  float covered = 0.0;  // the part of the footprint with valid normals
  for (int i = 0; i < components; ++i) {
    parts[i] = recovered(layers[i]);
    covered += parts[i].share;
  }
  if (covered <= 0.0) {
    parts[0] = Component(1.0, vec2(0.0), 0.0);
    covered = 1.0;
  }
  for (int i = 0; i < components; ++i) {
    parts[i].share /= covered;
    setComponent(e, i, parts[i]);
  }
#else
  setComponent(e, 0, Component(1.0, vec2(0.0), 0.0));
#endif
  return e;
}

Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo) {
  Reflected r;
  r.specular = vec3(0.0);
  if (halfVectorIsDefined(wi, wo)) {
    vec3 h = halfVector(wi, wo);
    float sum = 0.0;
    for (int i = 0; i < components; ++i) sum += componentReflectance(e, i, h, wi, wo);
    r.specular = fresnelTerm(s.f0, wi, wo) * sum;
  }
#if DIFFUSE && NORMAL_VARIATION && SPECULAR_JOINT && SPECULAR_VARIATION
  r.diffuse = diffuse(e.mean_normal, s, wi, wo);
#elif DIFFUSE
  r.diffuse = vec3(0.0);
  for (int i = 0; i < components; ++i) r.diffuse += e.share[i] * diffuse(e.mean[i], s, wi, wo);
#endif
  return r;
}

float ndf(Effective e, vec3 h) {
  float sum = 0.0;
  for (int i = 0; i < components; ++i) sum += componentDensity(e, i, h);
  return sum;
}

#if LOBES_LISTED
int lobeCount(Effective e) { return components * facetLobeCount(); }

#if LOBE_GAUSSIAN
// The round lobe with the solid angle above the Gaussian's area of the disc.
NormalLobe discNormalLobe(vec3 axis, float width, float amount, float base) {
  return vmfNormalLobe(axis, max(axis.z, sqrt(width)) / width, 2.0 * pi * width * amount, base);
}
#endif

#if MULTI_LOBE
NormalLobe facetLobeOfComponent(Effective e, int i, int k) {
  vec3 axis = turnedWithNormal(facet_lobes[k].axis, e.mean[i]);
#if LOBE_GAUSSIAN
  bool there = axis.z > 0.0 && e.amount[i] > 0.0;
  float base = clamp(facet_lobes[k].variance, 1e-6, 4.0);
  float width = widthOverDisc(e.spread[i], base, axis.z);
  float amount = there ? amountOverDisc(e.share[i], axis.xy, width, axis.z, base) : 0.0;
  NormalLobe lobe = discNormalLobe(axis, width, facet_lobes[k].weight * amount, facet_lobes[k].parameter);
#else
  NormalLobe lobe = baseNormalLobe(axis, widenedLobe(k, e.spread[i]), facet_lobes[k].weight * e.share[i]);
  lobe.base = facet_lobes[k].parameter;
#endif
  lobe.normal = e.mean[i];
  return lobe;
}
#endif

NormalLobe normalLobe(Effective e, int number) {
  int i = number / facetLobeCount();
#if MULTI_LOBE
  if (facet_lobe_count > 0) return facetLobeOfComponent(e, i, number % facet_lobe_count);
#endif
#if LOBE_GAUSSIAN
  return discNormalLobe(e.mean[i], e.width[i], e.amount[i], e.lobe);
#else
  NormalLobe lobe = baseNormalLobe(e.mean[i], e.width[i], e.share[i]);
  lobe.base = e.lobe;
  return lobe;
#endif
}

float lobeGeometry(Effective e, NormalLobe lobe, vec3 h, vec3 wi, vec3 wo) {
  return geometryFactor(lobe.base, lobe.normal, h, wi, wo);
}

vec3 meanNormal(Effective e) {
#if DIFFUSE && NORMAL_VARIATION && SPECULAR_JOINT && SPECULAR_VARIATION
  return e.mean_normal;
#endif
  vec3 sum = vec3(0.0);
  for (int i = 0; i < components; ++i) sum += e.share[i] * e.mean[i];
  return sum;
}
#endif
#endif
