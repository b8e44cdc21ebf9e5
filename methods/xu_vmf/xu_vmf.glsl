// Xu, Wang, Zhao, Bao 2017: the effective BRDF is a mixture of von Mises-Fisher lobes, one for each part of the
// hemisphere of normals; each is recovered from its characteristic vector, which the texture filter averages.
//? include xu_vmf_conversion.glsl
//? include xu_vmf_lobes.glsl
//? if texture_arrays
//? include xu_vmf_parts.glsl
//? end

// Adds the lobes of the parts that a footprint needs, for each of a facet's lobes; where none has one, facets are flat.
//
// The loop runs over the layers that the map has: a count that the compiler does not know, so that it unrolls nothing
// and compiles in a fraction of the time. It asks at its end: a software renderer runs a body that is asked for first
// once more than needed. It runs what a condition leaves out as well, but not a loop's further rounds: so every part is
// a round of its own, the whole hemisphere, which serves most footprints, the first, and a pixel goes on to what it
// needs next: the parts that this one is cut into, or those beyond it.
Effective effective(Footprints f) {
  Effective e;
  e.count = 0;
  for (int k = 0; k < facetsLobeCount(); ++k) {
    FacetsLobe own = facetsLobeAt(f, k);
    int first = e.count;
    e.covered = 0.0;
//? if texture_arrays
    Walk walk = walkOver(mapFootprint(f), k, own.shortfall);
    do {
      float weight;
      Part part = nextPart(walk, weight);
      if (hasLobe(part, weight)) {
        KeptLobe kept = lobeOfPart(own, part, weight);
        lobes[e.count] = kept.lobe;
        weights[e.count] = kept.weights;
//? if environment_light
        shares[e.count] = kept.share;
//? end
        ++e.count;
        e.covered += weight * part.r.w;
      }
    } while (walk.next < walk.parts);
//? end
    if (e.count == first) {
      KeptLobe kept = keptLobe(own, own.axis, own.shortfall, 1.0, 1.0);
      lobes[e.count] = kept.lobe;
      weights[e.count] = kept.weights;
//? if environment_light
      shares[e.count] = kept.share;
//? end
      ++e.count;
      e.covered = 1.0;
    }
//? if multi_lobe
    // Each of the facets' lobes has parts of its own, which cover what they cover.
    int i = first;
    do {
      weights[i] *= own.weight / vec2(amountsOf(e.covered), e.covered);
//? if environment_light
      shares[i].x *= own.weight / amountsOf(e.covered);
//? end
    } while (++i < e.count);
    e.covered = 1.0;
//? end
  }
  e.normal = vec3(0.0, 0.0, 1.0);
//? if multi_lobe and texture_arrays
  vec4 normals = fetch(xu_vmf_whole, facet_lobe_count, mapFootprint(f));
  if (normals.w >= least_share) e.normal = axisOf(normals.xyz / normals.w);
//? end
  return e;
}

// Facets with lobes of their own axes hide each other by their normals, whatever the axes.
vec3 geometryAxis(vec3 normal, vec3 mean) {
//? if multi_lobe
  if (facet_lobe_count > 0) return normal / max(length(normal), 1e-6);
//? end
  return mean;
}

// One loop for both terms: a lobe is dear to read.
Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo) {
  vec3 h = halfVector(wi, wo);
  float sum = 0.0;
  float cosine = 0.0;  // of the facets' unit normals with the light
  int i = 0;
  do {
    Lobe lobe = lobeOf(lobes[i], weights[i]);
    sum += lobe.amount * densityOf(lobe, h) * geometryFactor(lobe.base, geometryAxis(e.normal, lobe.mean), h, wi, wo);
    cosine += weights[i].y * max(dot(lobe.mean, wi), 0.0);
  } while (++i < e.count);
  Reflected r;
  r.specular = vec3(0.0);
  if (halfVectorIsDefined(wi, wo)) r.specular = fresnelTerm(s.f0, wi, wo) * (sum / amountsOf(e.covered));
//? if diffuse
  vec3 n = (cosine / e.covered) * wi;  // any normal of that cosine with the light
  float size = 1.0;
//? if multi_lobe
  if (facet_lobe_count > 0) {
    size = max(length(e.normal), 1e-6);
    n = e.normal / size;
  }
//? end
  r.diffuse = size * diffuse(n, s, wi, wo);
//? end
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

//? if environment_light
int lobeCount(Effective e) { return e.count; }

// A lobe reflects what its facets cover, seen along their own normals, and masks as they do: the density's integral is
// another, and the wide lobe that stands for them masks more.
NormalLobe normalLobe(Effective e, int i) {
  Lobe lobe = lobeOf(lobes[i], weights[i]);
  float share = shares[i].x / amountsOf(e.covered);
//? if lobe_base
//? if distribution_ggx
  // Seen along its axis GGX reflects 1 / (1 + alpha^2) of a furnace, and the rest below its horizon.
  share *= (1.0 + lobe.base * lobe.base) / (1.0 + shares[i].y * shares[i].y);
//? end
  NormalLobe normals = baseNormalLobe(lobe.mean, lobe.base, share);
  normals.base = shares[i].y;
  return normals;
//? else
  return vmfNormalLobe(lobe.mean, lobe.kappa, share, shares[i].y);
//? end
}

float lobeGeometry(Effective e, NormalLobe lobe, vec3 h, vec3 wi, vec3 wo) {
  return geometryFactor(lobe.base, geometryAxis(e.normal, lobe.axis), h, wi, wo);
}

vec3 meanNormal(Effective e) {
//? if multi_lobe
  if (facet_lobe_count > 0) return e.normal;
//? end
  vec3 sum = vec3(0.0);
  for (int i = 0; i < e.count; ++i) sum += weights[i].y * lobes[i].xyz;
  return sum / e.covered;
}
//? end
