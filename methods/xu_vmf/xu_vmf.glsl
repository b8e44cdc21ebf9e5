// Xu, Wang, Zhao, Bao 2017: the effective BRDF is a mixture of von Mises-Fisher lobes, one for each part of the
// hemisphere of normals. Each lobe is recovered from its characteristic vector, which the texture filter averages.
#include "xu_vmf_conversion.glsl"
#include "xu_vmf_lobes.glsl"
#if TEXTURE_ARRAYS
#include "xu_vmf_parts.glsl"
#endif
#if MASKING_FOOTPRINT && MASKING_SHADOWING && GEOMETRY_SMITH
#include "xu_vmf_masking.glsl"
#endif

// Adds the lobes of the parts that a footprint needs, for each lobe of a facet. Facets without any lobe are flat.
//
// The loop runs over the layers of the map, a number that the compiler does not know, so that it unrolls nothing and
// compiles in a fraction of the time. The condition is at the end, because a software renderer runs a body with the
// condition in front once more than needed. It also runs branches that a condition skips, but not further rounds of a
// loop. Therefore every part is one round: first the whole hemisphere, which serves most footprints, then as needed the
// parts of the current part, or those beyond it.
Effective effective(Footprints f) {
  Effective e;
  e.count = 0;
  for (int k = 0; k < facetsLobeCount(); ++k) {
    FacetsLobe own = facetsLobeAt(f, k);
    int first = e.count;
    e.covered = 0.0;
#if TEXTURE_ARRAYS
    Walk walk = walkOver(mapFootprint(f), k, own.shortfall);
    int rounds = 0;
    do {
      float weight;
      Part part = nextPart(walk, weight);
      if (hasLobe(part, weight)) {
        addLobe(e.count, lobeOfPart(own, part, weight));
        e.covered += weight * part.r.w;
      }
    } while (anotherRound(++rounds, walk.next < walk.parts));
#endif
    if (e.count == first) {
      addLobe(e.count, storedLobe(own, own.axis, own.shortfall, own.shortfall, 1.0, 1.0));
      e.covered = 1.0;
    }
#if MULTI_LOBE
    // Each lobe of the facets has its own parts and its own coverage.
    int i = first;
    do {
      weights[i] *= own.weight / vec2(amountsOf(e.covered), e.covered);
#if LOBES_LISTED || MASKING_FOOTPRINT
      shares[i].x *= own.weight / amountsOf(e.covered);
#endif
    } while (++i < e.count);
    e.covered = 1.0;
#endif
  }
  e.normal = vec3(0.0, 0.0, 1.0);
#if MULTI_LOBE && TEXTURE_ARRAYS
  vec4 normals = fetch(xu_vmf_whole, facet_lobe_count, mapFootprint(f));
  if (normals.w >= least_share) e.normal = axisOf(normals.xyz / normals.w);
#endif
  return e;
}

// Facets with lobes about their own axes mask each other by their normals.
vec3 geometryAxis(vec3 normal, vec3 mean) {
#if MULTI_LOBE
  if (facet_lobe_count > 0) return normal / max(length(normal), 1e-6);
#endif
  return mean;
}

// The geometry factor of a lobe. `of_all`: that of all lobes, if one masks another.
float lobeFactor(Effective e, vec3 mean, float base, float of_all, vec3 h, vec3 wi, vec3 wo) {
#if MASKING_FOOTPRINT && MASKING_SHADOWING && GEOMETRY_SMITH
#if MULTI_LOBE
  if (facet_lobe_count == 0) return of_all;
#else
  return of_all;
#endif
#endif
  return geometryFactor(base, geometryAxis(e.normal, mean), h, wi, wo);
}

float factorOfAll(Effective e, vec3 wi, vec3 wo) {
#if MASKING_FOOTPRINT && MASKING_SHADOWING && GEOMETRY_SMITH
  return footprintFactor(e.count, wi, wo);
#else
  return 1.0;
#endif
}

// One loop for both terms, because reading a lobe is expensive.
Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo) {
  vec3 h = halfVector(wi, wo);
  float sum = 0.0;
  float cosine = 0.0;  // of the facets' unit normals with the light
  float of_all = factorOfAll(e, wi, wo);
  int count = lobesHere(e.count);
  int i = 0;
  do {
    Lobe lobe = lobeOf(lobes[i], weights[i]);
    sum += lobe.amount * densityOf(lobe, h) * lobeFactor(e, lobe.mean, lobe.base, of_all, h, wi, wo);
    cosine += weights[i].y * max(dot(lobe.mean, wi), 0.0);
  } while (++i < count);
  Reflected r;
  r.specular = vec3(0.0);
  if (halfVectorIsDefined(wi, wo)) r.specular = fresnelTerm(s.f0, wi, wo) * (sum / amountsOf(e.covered));
#if DIFFUSE
  vec3 n = (cosine / e.covered) * wi;  // any normal with that cosine to the light
  float size = 1.0;
#if MULTI_LOBE
  if (facet_lobe_count > 0) {
    size = max(length(e.normal), 1e-6);
    n = e.normal / size;
  }
#endif
  r.diffuse = size * diffuse(n, s, wi, wo);
#endif
  return r;
}

float ndf(Effective e, vec3 h) {
  float sum = 0.0;
  for (int i = 0; i < e.count; ++i) {
    Lobe lobe = lobeOf(lobes[i], weights[i]);
    sum += lobe.amount * densityOf(lobe, h);
  }
  return sum / amountsOf(e.covered);
}

#if LOBES_LISTED
int lobeCount(Effective e) { return e.count; }

// A lobe reflects the share that its facets cover, seen along their own normals, and masks as they do. The integral of
// its density differs from that share, and the wide lobe alone would mask more.
NormalLobe normalLobe(Effective e, int i) {
  Lobe lobe = lobeOf(lobes[i], weights[i]);
  float share = shares[i].x / amountsOf(e.covered);
#if LOBE_BASE
#if DISTRIBUTION_GGX
  // Along its axis GGX reflects 1 / (1 + alpha^2) of a furnace; the rest is below its horizon.
  share *= (1.0 + lobe.base * lobe.base) / (1.0 + shares[i].y * shares[i].y);
#endif
  NormalLobe normals = baseNormalLobe(lobe.mean, lobe.base, share);
  normals.base = shares[i].y;
  return normals;
#else
  return vmfNormalLobe(lobe.mean, lobe.kappa, share, shares[i].y);
#endif
}

float lobeGeometry(Effective e, NormalLobe lobe, vec3 h, vec3 wi, vec3 wo) {
  return lobeFactor(e, lobe.axis, lobe.base, factorOfAll(e, wi, wo), h, wi, wo);
}

vec3 meanNormal(Effective e) {
#if MULTI_LOBE
  if (facet_lobe_count > 0) return e.normal;
#endif
  vec3 sum = vec3(0.0);
  for (int i = 0; i < e.count; ++i) sum += weights[i].y * lobes[i].xyz;
  return sum / e.covered;
}
#endif
