// Environment light for prefiltered footprints. Each lobe of the NDF reads the mean of the environment over its
// reflected lobe (Wang 2009) from a stack of prefiltered maps (Kautz 2000).
layout(std140, binding = 5) uniform EnvironmentBlock {
  vec4 environment_mean;         // radiance over all directions
  vec4 environment_stack_range;  // sharpness of the finest map's lobe, number of maps: two per level
#if ENVIRONMENT_SUNS
  vec4 environment_suns[2 * environment_sun_count];  // each: towards it, world space; irradiance on what faces it
#endif
};

#include "octahedral.glsl"

// Map 2 l is level l of layer 0; map 2 l + 1 is level l of layer 1.
vec3 stackMap(int map, vec2 uv) {
  int level = map >> 1;
  vec2 size = levelSize(textureSize(environment_stack, 0).xy, level);
  countLookups(1);
  return textureLod(environment_stack, vec3(borderedUv(uv, size), map & 1), float(level)).rgb;
}

// The mean of the environment over a vMF lobe. The sharpness halves from map to map; between two maps it is linear in
// the logarithm of the sharpness, with an error below 6%. Beyond the last map it approaches the mean over all
// directions.
vec3 stackRadiance(vec3 axis, float sharpness) {
  vec2 uv = octahedral(axis);
  float finest = environment_stack_range.x;
  int last = int(environment_stack_range.y) - 1;
  float steps = log2(finest / max(sharpness, 1e-6));
  if (steps >= float(last)) return mix(environment_mean.rgb, stackMap(last, uv), exp2(float(last) - steps));
  steps = max(steps, 0.0);
  int map = min(int(steps), last - 1);
  return mix(stackMap(map, uv), stackMap(map + 1, uv), steps - float(map));
}

// The share of a vMF lobe above a plane; t is the cosine between axis and normal. Error below 0.021. A logistic
// function with the right slope at t = 0 for small and large sharpness k, and the exact value 1 / (1 + e^-k) at t = 1.
float shareAbove(float t, float k) {
  float slope = k * inversesqrt(1.0 + k / 2.546);
  return 1.0 / (1.0 + exp(-clamp(slope * t + (k - slope) * t * t * t, -80.0, 80.0)));
}

// The lobe weighted by the visible area (h.wo) of its facets; back-facing facets are invisible.
struct VisibleLobe {
  vec3 axis;   // mean of the visible normals
  float area;  // mean of max(h.wo, 0)
};

// In the tangent plane at the axis the lobe is a Gaussian and (h.wo) is linear: moments of a truncated Gaussian.
VisibleLobe visibleLobe(NormalLobe lobe, vec3 wo) {
  float c = dot(lobe.axis, wo);
  vec3 across = wo - c * lobe.axis;
  float sine = length(across);
  float deviation = inversesqrt(lobe.sharpness);
  if (sine < 1e-4) return VisibleLobe(lobe.axis, max(c, 0.0));
  float a = max(c / (sine * deviation), -5.0);
  float facing = normalCdf(a);
  float mean = a * facing + inverse_root_two_pi * exp(-0.5 * a * a);
  vec3 shifted = lobe.axis + across * (deviation * facing / (max(mean, 1e-7) * sine));
  return VisibleLobe(normalize(shifted), sine * deviation * max(mean, 0.0));
}

#if ENVIRONMENT_VISIBILITY
#include "environment_visibility.glsl"
#else
float visibleElevation(vec3 direction, float elevation) { return elevation; }
#endif

#if ENVIRONMENT_SUNS
// A sun that is too small for lookups and removed from the maps.
vec3 sunLit(SurfacePoint p, vec3 direction, vec3 irradiance) {
#if ENVIRONMENT_VISIBILITY
  if (!isVisible(direction)) return vec3(0.0);
#endif
  return reflected(p, incident(direction * p.frame, irradiance, vec4(direction, 0.0)));
}

vec3 sunRadiance(SurfacePoint p) {
  vec3 radiance = vec3(0.0);
  int i = 0;
  do {
    radiance += sunLit(p, environment_suns[2 * i].xyz, environment_suns[2 * i + 1].rgb);
  } while (++i < environment_sun_count);
  return radiance;
}
#endif

// The normal of the plane below which light does not count for a lobe: that of the surface or, with an open horizon, of
// the facets of the lobe.
vec3 horizonNormal(NormalLobe lobe) {
#if HORIZON_OPEN
  return lobe.normal;
#else
  return vec3(0.0, 0.0, 1.0);
#endif
}

// The lobe of reflected directions: mean and sharpness.
struct ReflectedLobe {
  vec3 axis;
  float sharpness;
};

// The vMF lobe of a uniform hemisphere: mean cosine 1/2.
const float hemisphere_sharpness = 1.83;

// The part of a lobe above the plane of n, as a lobe. A Gaussian cut along a line moves away from it, and its variance
// shrinks; a wide lobe becomes a hemisphere.
ReflectedLobe aboveHorizon(ReflectedLobe lobe, vec3 n, float share) {
  float t = dot(n, lobe.axis);
  float a = max(t * sqrt(lobe.sharpness), -5.0);
  float shift = inverse_root_two_pi * exp(-0.5 * a * a) / max(normalCdf(a), 1e-7);
  vec3 across = n - t * lobe.axis;
  float sine2 = dot(across, across);
  vec3 moved = lobe.axis;
  if (sine2 > 1e-8) moved += across * (shift * inversesqrt(lobe.sharpness * sine2));
  float lost = sine2 * min(shift * (a + shift), 0.98);  // of the variance across the line
  float sharpness = lobe.sharpness * 2.0 / (2.0 - lost) + hemisphere_sharpness * min(2.0 - 2.0 * share, 1.0);
  return ReflectedLobe(normalize(moved), sharpness);
}

// The factor of lobe i in f cos besides density, F and G', or the complete factor of a module with small-scale
// geometry. `sharpness`: that of the lobe of light directions about wi.
struct Beside {
  float weight;
  vec3 color;
};

#if CLEAR_COAT
// Passed instead of a lobe index for the coat; its weight, share and spread replace f0.
const int coat_lobe = -1;
#endif

Beside besideDensity(Effective e, int i, NormalLobe lobe, vec3 f0, vec3 h, vec3 wi, vec3 wo, float sharpness) {
#if MICROGEOMETRY_VISIBILITY
  vec3 all = lobeReflectance(e, i, f0, h, wi, wo, sharpness);
  float mean = dot(all, vec3(1.0 / 3.0));
  return Beside(mean, all / max(mean, 1e-12));
#else
  return Beside(lobeGeometry(e, lobe, h, wi, wo), fresnelTerm(f0, wi, wo));
#endif
}

// The radiance that a lobe reflects towards wo: the integral of F D G' L over wi. With dwi = 4 (h.wo) dh, the energy of
// the reflected lobe is 4 times its visible area, and its width about the mirrored mean of the visible normals is 4
// (axis.wo) times larger (Wang 2009). F and G' are evaluated at that direction. Light below the horizon is excluded.
vec3 lobeRadiance(Effective e, int i, NormalLobe lobe, vec3 f0, vec3 wo, mat3 frame) {
  VisibleLobe visible = visibleLobe(lobe, wo);
  float cosine = max(dot(visible.axis, wo), 0.01);
  vec3 mirrored = 2.0 * cosine * visible.axis - wo;
  ReflectedLobe whole = ReflectedLobe(mirrored / max(length(mirrored), 1e-6), lobe.sharpness / (4.0 * cosine));
  vec3 n = horizonNormal(lobe);
  float elevation = dot(n, whole.axis);
  ReflectedLobe above = aboveHorizon(whole, n, shareAbove(elevation, whole.sharpness));
  float share = shareAbove(visibleElevation(frame * whole.axis, elevation), whole.sharpness);
  Beside beside = besideDensity(e, i, lobe, f0, visible.axis, whole.axis, wo, whole.sharpness);
  float reflected = 4.0 * lobe.weight * visible.area * share * beside.weight;
  return beside.color * reflected * stackRadiance(frame * above.axis, above.sharpness);
}

#if DISTRIBUTION_GGX || CLEAR_COAT
// GGX has a longer tail than any Gaussian, and wide lobes reflect below the horizon, where masking is strongest. So the
// visible normals near the axis and the others look up the environment separately. A table over view and alpha stores
// the energy, direction and sharpness of both vMF lobes (radiance_stack.hpp).
const float smith_steps = 4.0;  // of radiance_stack.hpp

// Where the table includes the geometry factor of the base BRDF.
float geometryStep(NormalLobe lobe, float alpha) {
#if MASKING_SHADOWING && GEOMETRY_SMITH
  return smith_steps * clamp(lobe.base / alpha, 0.0, 1.0);
#elif MASKING_SHADOWING && GEOMETRY_TAN
  return smith_steps + 1.0;
#else
  return smith_steps + 2.0;
#endif
}

struct TailedLobe {
  float alpha;
  vec2 table;     // coordinates in environment_lobes
  vec3 mirrored;  // image of the view about the axis
  vec3 across;    // from there towards the view
};

TailedLobe tailedLobe(NormalLobe lobe, vec3 wo) {
  float c = clamp(dot(lobe.axis, wo), -1.0, 1.0);
  float sine = sqrt(max(1.0 - c * c, 1e-12));
  vec2 size = vec2(textureSize(environment_lobes, 0).xy);
  float alpha = inversesqrt(0.5 * lobe.sharpness);
  float narrowest = sqrt(smallest_alpha);
  vec2 at = vec2(0.5 + 0.5 * sign(c) * sqrt(abs(c)), (sqrt(alpha) - narrowest) / (1.0 - narrowest));
  vec3 tangent = (wo - c * lobe.axis) / sine;
  vec2 table = (at * (size - 1.0) + 0.5) / size;
  return TailedLobe(alpha, table, c * lobe.axis - sine * tangent, c * tangent + sine * lobe.axis);
}

// The ratio of a geometry factor to that of the table in a direction: for modules with their own factor, or another
// normal.
vec3 ownGeometry(Effective e, int i, NormalLobe lobe, vec3 f0, vec3 wi, vec3 wo, float sharpness) {
#if DISTRIBUTION_GGX
  vec3 h = halfVector(wi, wo);
  float table = max(geometryFactor(min(lobe.base, inversesqrt(0.5 * lobe.sharpness)), lobe.axis, h, wi, wo), 1e-6);
#if MICROGEOMETRY_VISIBILITY
  return min(lobeReflectance(e, i, f0, h, wi, wo, sharpness) / max(table * fresnelTerm(f0, wi, wo), 1e-6), 4.0);
#else
  return vec3(min(lobeGeometry(e, lobe, h, wi, wo) / table, 4.0));
#endif
#else
  return vec3(1.0);
#endif
}

#if !HORIZON_OPEN
// The part of a lobe above the plane of the surface, as a lobe: the ratio of the shares above it and above the facets',
// which the table includes. The last factor is fitted, because a wide truncated lobe is not Gaussian.
float cutByHorizon(inout ReflectedLobe lobe, vec3 own_normal, vec3 n, float alpha) {
  float own = shareAbove(dot(own_normal, lobe.axis), lobe.sharpness);
  float share = shareAbove(dot(n, lobe.axis), lobe.sharpness);
  ReflectedLobe above = aboveHorizon(lobe, n, share);
  float by = clamp((own - share) / max(1.0 - share, 1e-4), 0.0, 1.0);
  lobe = ReflectedLobe(normalize(mix(lobe.axis, above.axis, by)), mix(lobe.sharpness, above.sharpness, by));
  float left = min(share / own, 1.0);
  return left * mix(1.0, left, alpha);
}
#endif

// Half 0 or 1 of a lobe from the table, interpolated between two steps of the geometry factor.
vec4 tablePart(TailedLobe tailed, float geometry, int half_of) {
  float lower = floor(geometry);
  float layer = 2.0 * lower + float(half_of);
  countLookups(1);
  vec4 part = textureLod(environment_lobes, vec3(tailed.table, layer), 0.0);
  if (geometry == lower) return part;
  countLookups(1);
  return mix(part, textureLod(environment_lobes, vec3(tailed.table, layer + 2.0), 0.0), geometry - lower);
}

vec3 partRadiance(Effective e, int i, NormalLobe lobe, TailedLobe tailed, vec4 part, vec3 f0, vec3 wo, mat3 frame) {
  vec3 axis = cos(part.b) * tailed.mirrored + sin(part.b) * tailed.across;
  ReflectedLobe above = ReflectedLobe(axis, exp2(part.a) * 0.5 * lobe.sharpness);
  float share = lobe.weight;
#if !HORIZON_OPEN
  share *= cutByHorizon(above, lobe.axis, vec3(0.0, 0.0, 1.0), tailed.alpha);
#endif
#if ENVIRONMENT_VISIBILITY
  float elevation = dot(horizonNormal(lobe), above.axis);
  share *= shareAbove(visibleElevation(frame * above.axis, elevation), above.sharpness) /
           shareAbove(elevation, above.sharpness);
#endif
  vec3 energy = vec3(part.r + part.g);
#if CLEAR_COAT
  if (i == coat_lobe) {
    Coat coat = Coat(lobe.normal, 2.0 / lobe.sharpness, f0.x, f0.y, f0.z);
    energy *= coatShare(coat, halfVector(axis, wo), wo);
  } else {
#endif
#if FRESNEL && FRESNEL_SCHLICK
    energy = part.r * f0 + part.g;
#else
    energy *= f0;
#endif
    energy *= ownGeometry(e, i, lobe, f0, axis, wo, above.sharpness);
#if CLEAR_COAT
  }
#endif
  return share * energy * stackRadiance(frame * above.axis, above.sharpness);
}

vec3 tailedRadiance(Effective e, int i, NormalLobe lobe, float geometry, vec3 f0, vec3 wo, mat3 frame) {
  TailedLobe tailed = tailedLobe(lobe, wo);
  return partRadiance(e, i, lobe, tailed, tablePart(tailed, geometry, 0), f0, wo, frame) +
         partRadiance(e, i, lobe, tailed, tablePart(tailed, geometry, 1), f0, wo, frame);
}
#endif

vec3 environmentSpecular(Effective e, vec3 f0, vec3 wo, mat3 frame) {
  vec3 radiance = vec3(0.0);
  int count = lobesHere(lobeCount(e));
  int i = 0;
  do {
    NormalLobe lobe = normalLobe(e, i);
    if (lobe.weight <= 0.0) continue;
    countLobes(1);
#if DISTRIBUTION_GGX
    if (lobe.tailed) {
      radiance += tailedRadiance(e, i, lobe, geometryStep(lobe, inversesqrt(0.5 * lobe.sharpness)), f0, wo, frame);
      continue;
    }
#endif
    radiance += lobeRadiance(e, i, lobe, f0, wo, frame);
  } while (++i < count);
  return radiance;
}

#if ENVIRONMENT_DIFFUSE
#if FRESNEL
// The mean over a uniform hemisphere, weighted by the cosine, of the light that Schlick's term transmits. (1 - v.h)^5
// has the mean 0.0282 (1 - n.v)^2.6 + 0.0001, to 5e-4.
vec3 meanTransmitted(vec3 f0, float cosine) {
#if FRESNEL_SCHLICK
  return (1.0 - f0) * (0.9999 - 0.0282 * pow(1.0 - clamp(cosine, 0.0, 1.0), 2.6));
#else
  return vec3(1.0);
#endif
}
#endif

DiffuseFacets diffuseFacets(Effective e, vec3 wo) {
#if MICROGEOMETRY_VISIBILITY
  return visibleFacets(e, wo);
#else
  vec3 m = meanNormal(e);
#if HORIZON_OPEN
  return DiffuseFacets(m, vec3(1.0), false);
#else
  return DiffuseFacets(m, vec3(clamp(0.5 + 0.5 * m.z, 0.0, 1.0)), false);
#endif
#endif
}

// Lambert's term over all directions. Irradiance is almost linear in the normal: the mean over all directions plus |m|
// times the difference to it. With a horizon, an inclined facet loses (1 - n_z) / 2 of a constant environment.
vec3 environmentDiffuse(Effective e, vec3 albedo, vec3 f0, vec3 wo, mat3 frame) {
  DiffuseFacets facets = diffuseFacets(e, wo);
  float size = length(facets.mean_normal);
  vec3 n = size > 1e-6 ? facets.mean_normal / size : vec3(0.0, 0.0, 1.0);
  vec2 irradiance_size = vec2(textureSize(environment_irradiance, 0));
  vec2 uv = borderedUv(octahedral(frame * n), irradiance_size);
  countLookups(1);
  vec3 facing = textureLod(environment_irradiance, uv, 0.0).rgb;  // irradiance over pi
  vec3 reflected = facets.share * mix(environment_mean.rgb, facing, min(size, 1.0));
#if ENVIRONMENT_VISIBILITY
  reflected *= visibleDiffuse();
#endif
  if (facets.whole) return reflected;
  reflected *= albedo;
#if FRESNEL
  reflected *= meanTransmitted(f0, dot(n, wo));
#endif
  return reflected;
}
#endif

vec3 environmentLit(Effective e, Surface s, vec3 wo, mat3 frame) {
  vec3 radiance = environmentSpecular(e, s.f0, wo, frame);
#if ENVIRONMENT_DIFFUSE
  radiance += environmentDiffuse(e, s.albedo, s.f0, wo, frame);
#endif
  return radiance;
}

#if CLEAR_COAT
// The light of the environment that the coat reflects, times its share.
vec3 coatLit(SurfacePoint p) {
  if (p.coat.share <= 0.0) return vec3(0.0);
  countLobes(1);
  NormalLobe lobe = NormalLobe(p.coat.normal, 2.0 / p.coat.alpha2, 1.0, 0.0, true, p.coat.normal);
  vec3 shares = vec3(p.coat.weight, p.coat.share, p.coat.spread);
  return tailedRadiance(p.effective, coat_lobe, lobe, smith_steps, shares, p.wo, p.frame);
}
#endif
