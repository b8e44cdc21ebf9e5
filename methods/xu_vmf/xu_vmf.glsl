// Xu, Wang, Zhao, Bao 2017: the effective BRDF is a mixture of von Mises-Fisher lobes, one for each part of the
// hemisphere of normals; each is recovered from its characteristic vector, which the texture filter averages.

// xu_vmf_conversion.glsl and xu_vmf_cells.glsl, behind this text.
float shortfallOf(float kappa);
float kappaOf(float q);
float kappaOfLobe(float lobe);
float lobeOfKappa(float kappa);
int cellOf(vec3 r);
int partOfCell(int cell);
//? if j_4
const int part_count = 4;
//? else
const int part_count = 8;
//? end

//? if j_1
const int most_of_one = 1;
//? else
//? if j_4
const int most_of_one = 4;
//? else
//? if thresholds_blended
const int most_of_one = 13;  // on the way from one lobe to 4 parts, and in each of these on the way to 2
//? else
const int most_of_one = 8;
//? end
//? end
//? end
//? if multi_lobe
const int most_lobes = most_of_one * most_facet_lobes;
//? else
const int most_lobes = most_of_one;
//? end

// A pixel's lobes, 0 to count - 1: mean direction times share of the footprint, and 1 - |r|. Few numbers, since an array
// whose index is not known is dear to write and to read. They are no member of Effective, which functions take by value:
// a software renderer would copy them all at every call.
vec4 lobes[most_lobes];
//? if variant_published
float amounts[most_lobes];  // what each adds with; it is the share where lobes weigh what they cover
//? end
//? if multi_lobe
float facet_energies[most_lobes];  // of the facets' lobe that each stands for
//? end

struct Effective {
  int count;
  float covered;  // of the footprint, by the lobes of one of the facets'
//? if multi_lobe
  vec3 normal;  // mean of the unit normals of facets with lobes of their own axes
//? end
};

// A part that covers less of the footprint is left out, and no division is by nothing.
const float least_share = 1e-4;

//? if lobe_vmf
//? if not distribution_vmf
//? include vmf_density.glsl
//? end
//? end

// Of the facets' lobe that is looked up: 1 - |r|, and the energy of its base lobe. Where roughness varies, of the lobe
// of their mean variance.
float facet_shortfall, facet_energy;

// The energy of a base lobe over solid angle. That of a microfacet lobe grows with its width, while the mean of narrow
// ones keeps theirs: a wide lobe that stands for them is scaled by the ratio.
float energyOf(float base) {
//? if lobe_base
  return lobeEnergy(base);
//? else
  return 1.0;
//? end
}

float facetEnergy(int i) {
//? if multi_lobe
  return facet_energies[i];
//? else
  return facet_energy;
//? end
}

struct Lobe {
  vec3 mean;
  float kappa;
  float base;    // the base lobe of that width
  float share;   // of the footprint's facets, but as published
  float amount;  // what its density is multiplied by
};

Lobe lobeAt(int i) {
  vec4 lobe = lobes[i];
  float size = length(lobe.xyz);
  float kappa = kappaOf(lobe.w);
  float base = lobeOfKappa(kappa);
//? if variant_published
  float share = amounts[i];
//? else
  float share = size;
//? end
  return Lobe(lobe.xyz / max(size, 1e-30), kappa, base, share, share * facetEnergy(i) / energyOf(base));
}

float densityOf(Lobe lobe, vec3 h) {
//? if lobe_base
  return lobeDensity(lobe.base, lobe.mean, h);
//? else
//? if distribution_vmf
  return lobeDensity(lobe.kappa, lobe.mean, h);
//? else
  return vmfDensity(lobe.kappa, lobe.mean, h);
//? end
//? end
}

// A facet's lobe: about its normal, or with an axis and a weight of its own.
struct OwnLobe {
  vec3 axis;
  float parameter, weight;
};

OwnLobe baseLobe(Footprints f) {
//? if roughness_variation
  return OwnLobe(vec3(0.0, 0.0, 1.0), lobeFromVariance(fetch(xu_vmf_variances, f.roughness).r), 1.0);
//? else
  return OwnLobe(vec3(0.0, 0.0, 1.0), lobe_cutoff.x, 1.0);
//? end
}

//? if multi_lobe
int ownLobeCount() { return max(facet_lobe_count, 1); }
OwnLobe ownLobe(Footprints f, int k) {
  if (facet_lobe_count > 0) return OwnLobe(facet_lobes[k].axis, facet_lobes[k].parameter, facet_lobes[k].weight);
  return baseLobe(f);
}
//? else
int ownLobeCount() { return 1; }
OwnLobe ownLobe(Footprints f, int k) { return baseLobe(f); }
//? end

void pushLobe(inout Effective e, vec3 mean, float q, float share, float amount) {
  lobes[e.count] = vec4(share * mean, q);
//? if variant_published
  amounts[e.count] = amount;
//? end
  ++e.count;
}

//? if texture_arrays
// Half floats round |r| by as much; where the lobes spread less than that, nothing is known of how much.
//? if storage_fp16
const float dead_zone = 1.0 / 2048.0;
//? else
const float dead_zone = 0.0;
//? end

// A part of the footprint: (w r, w), and w times the mean of 1 - |r| of its texels, below which 1 - |r| of the mean
// cannot lie, however it was rounded: |mean r| <= mean |r|.
struct Part {
  vec4 r;
  float least;
};

//? if surface_coordinates
Footprint placeOf(Footprints f) { return f.surface; }
// The map has the camera's axes, but where no atlas could be made for it.
vec3 axisOf(vec3 r) { return xu_vmf_in_camera_space > 0.5 ? r * tangent_to_camera : r; }
//? else
//? if normal_variation
Footprint placeOf(Footprints f) { return f.normal; }
//? else
Footprint placeOf(Footprints f) { return f.roughness; }
//? end
vec3 axisOf(vec3 r) { return r; }
//? end

//? if roughness_variation
//? if storage_fp16
Part partOf(vec4 r, float least) { return Part(r, least); }
//? else
Part partOf(vec4 r, float least) { return Part(r, 0.0); }
//? end
//? else
Part partOf(vec4 r, float least) { return Part(r, r.w * facet_shortfall); }
//? end

Part wholeAt(Footprint f, int own) {
  float least = 0.0;
//? if storage_fp16
//? if roughness_variation
  least = fetch(xu_vmf_whole_guard, 0, f).r;
//? end
//? end
  return partOf(fetch(xu_vmf_whole, own, f), least);
}

// A part's lobe, where `weight` of it counts.
void addLobe(inout Effective e, Part part, float weight) {
  if (part.r.w < least_share || weight <= 0.0) return;
  vec3 r = part.r.xyz / part.r.w;
  float size = length(r);
  float q = max(1.0 - size - dead_zone, part.least / part.r.w);
  vec3 mean = size < 1e-6 ? vec3(0.0, 0.0, 1.0) : axisOf(r / size);
  float share = weight * part.r.w;
  pushLobe(e, mean, clamp(q, 1.0 / largest_exponent, 1.0), share, weight);
  e.covered += share;
}

//? if sampling_frame
//? if not j_1
// Where a part of one of the facets' lobes is looked up. Its finest level is not stored: the texels of the whole
// hemisphere's stand in for it below level 1, each for the part that its lobe is in.
struct Probe {
  int own;
  vec2 uv;
  float level;
  mat4 texel;    // a column each, by its share
  vec4 least;
  ivec4 part;
};

// The four texels about a place come by their channels, gathered from the middle between them, where no hardware rounds
// to others.
mat4 texelsAbout(sampler2DArray map, vec3 middle) {
  return transpose(mat4(textureGather(map, middle, 0), textureGather(map, middle, 1), textureGather(map, middle, 2),
                        textureGather(map, middle, 3)));
}

Probe probeAt(int own, vec2 uv, float level) {
  Probe p;
  p.own = own;
  p.uv = uv;
  p.level = level;
  vec2 size = vec2(textureSize(xu_vmf_whole, 0).xy);
  vec2 place = uv * size - 0.5;
  vec2 corner = floor(place);
  vec2 beyond = place - corner;
  vec3 middle = vec3((corner + 1.0) / size, own);
  vec4 share = vec4(1.0 - beyond.x, beyond.x, beyond.x, 1.0 - beyond.x) *
               vec4(beyond.y, beyond.y, 1.0 - beyond.y, 1.0 - beyond.y);  // in the order of textureGather
  share *= 1.0 - clamp(level, 0.0, 1.0);
  p.texel = texelsAbout(xu_vmf_whole, middle);
  for (int i = 0; i < 4; ++i) {
    p.part[i] = partOfCell(cellOf(p.texel[i].xyz));
    p.texel[i] *= share[i];
  }
  p.least = vec4(0.0);
//? if storage_fp16
//? if roughness_variation
  p.least = share * textureGather(xu_vmf_whole_guard, middle, 0);
//? end
//? end
  return p;
}

// One part under one probe.
Part partAt(Probe p, int part) {
  float share = clamp(p.level, 0.0, 1.0);
  vec3 place = vec3(p.uv, p.own * part_count + part);
  vec4 r = share * textureLod(xu_vmf_parts, place, p.level - 1.0);
  float least = 0.0;
//? if storage_fp16
//? if roughness_variation
  least = share * textureLod(xu_vmf_parts_guard, place, p.level - 1.0).r;
//? end
//? end
  for (int i = 0; i < 4; ++i) {
    bool own = p.part[i] == part;
    r += own ? p.texel[i] : vec4(0.0);
    least += own ? p.least[i] : 0.0;
  }
  return partOf(r, least);
}

Part sumOf(Part a, Part b) { return Part(a.r + b.r, a.least + b.least); }

//? if anisotropic
Part partUnder(Footprint f, int own, int part) {
  Probes p = probesOf(vec2(textureSize(xu_vmf_whole, 0).xy), f);
  Part sum = Part(vec4(0.0), 0.0);
  for (int i = 0; i < p.count; ++i) sum = sumOf(sum, partAt(probeAt(own, probeUv(f, p, i), p.level), part));
  return Part(sum.r / float(p.count), sum.least / float(p.count));
}
//? end

// How far one lobe serves a part: 1 wholly, 0 not at all. Algorithm 1 steps at the threshold.
float unityOf(Part part, float threshold) {
  float size = length(part.r.xyz) / max(part.r.w, 1e-30);
//? if thresholds_blended
  return clamp((size - threshold) / 0.02 + 1.0, 0.0, 1.0);
//? else
  return size > threshold ? 1.0 : 0.0;
//? end
}

// Loops run over the layers that the map has: a count that the compiler does not know, so that it unrolls nothing and
// compiles in a fraction of the time. They ask at their end: a software renderer runs a body that is asked for first
// once more than needed. It runs what a condition leaves out as well, but not a loop's further rounds: so the lobe of
// the whole hemisphere, which serves most footprints, is the first round.
void addParts(inout Effective e, Footprint f, int own) {
  int layers = textureSize(xu_vmf_parts, 0).z / ownLobeCount();
//? if not anisotropic
  Probe probe = probeAt(own, f.uv, levelOf(vec2(textureSize(xu_vmf_whole, 0).xy), f));
//? end
//? if j_adaptive
  Part whole = wholeAt(f, own);
  float whole_unity = unityOf(whole, option_eps0);
  Part first = whole;
  Effective before = e;
  int i = -1;
//? else
  int i = 0;
//? end
  do {
//? if anisotropic
    Part part = partUnder(f, own, max(i, 0));
//? else
    Part part = partAt(probe, max(i, 0));
//? end
    float weight = 1.0;
//? if j_adaptive
    // A coarse cell is the sum of its two fine ones, so that it needs no layer of its own. Where it is not to be cut, it
    // takes the place of both.
    weight = 1.0 - whole_unity;
    if (i < 0) {
      part = whole;
      weight = whole_unity;
    } else if (i % 2 == 0) {
      before = e;
      first = part;
    } else {
      Part both = sumOf(first, part);
      float unity = unityOf(both, option_eps1);
//? if thresholds_blended
      e = before;
      addLobe(e, first, weight * (1.0 - unity));
      addLobe(e, both, weight * unity);
      weight *= 1.0 - unity;
//? else
      if (unity > 0.0) {
        e = before;
        part = both;
      }
//? end
    }
//? end
    addLobe(e, part, weight);
//? if j_adaptive
    if (whole_unity >= 1.0) break;
//? end
  } while (++i < layers);
}
//? end
//? end

// Algorithm 1. A sample of the finest level has one texel, or what is blended of texels: one lobe.
void addLobes(inout Effective e, Footprint f, int own) {
//? if sampling_frame
//? if j_1
  addLobe(e, wholeAt(f, own), 1.0);
//? else
  addParts(e, f, own);
//? end
//? else
  addLobe(e, wholeAt(f, own), 1.0);
//? end
}
//? end

void addOwnLobe(inout Effective e, Footprints f, int k) {
  OwnLobe own = ownLobe(f, k);
  float q = shortfallOf(kappaOfLobe(own.parameter));
  facet_shortfall = q;
  facet_energy = energyOf(own.parameter);
  int first = e.count;
  e.covered = 0.0;
//? if texture_arrays
  addLobes(e, placeOf(f), k);
//? end
  if (e.count == first) {  // flat facets
    pushLobe(e, own.axis, q, 1.0, 1.0);
    e.covered = 1.0;
  }
//? if sampling_texel
  // The lobe of the one texel that was drawn is a facet's own. The roughness map may have drawn another.
  facet_shortfall = lobes[first].w;
  facet_energy = energyOf(lobeOfKappa(kappaOf(facet_shortfall)));
//? end
  int i = first;
  do {
    // Whole: Mesa 22.3 loses w where x, y and z alone are written.
    lobes[i] *= vec4(vec3(own.weight / e.covered), 1.0);
//? if variant_published
    amounts[i] *= own.weight;
//? end
//? if multi_lobe
    facet_energies[i] = facet_energy;
//? end
  } while (++i < e.count);
}

Effective effective(Footprints f) {
  Effective e;
  e.count = 0;
//? if multi_lobe
  for (int k = 0; k < ownLobeCount(); ++k) addOwnLobe(e, f, k);
  e.normal = vec3(0.0, 0.0, 1.0);
//? if texture_arrays
  vec4 normals = fetch(xu_vmf_whole, facet_lobe_count, placeOf(f));
  if (normals.w >= least_share) e.normal = axisOf(normals.xyz / normals.w);
//? end
//? else
  addOwnLobe(e, f, 0);
//? end
  return e;
}

// Facets with lobes of their own axes hide each other by their normals, whatever the axes.
vec3 geometryAxis(Effective e, vec3 mean) {
//? if multi_lobe
  if (facet_lobe_count > 0) return e.normal / max(length(e.normal), 1e-6);
//? end
  return mean;
}

vec3 specular(Effective e, vec3 f0, vec3 wi, vec3 wo) {
  if (!halfVectorIsDefined(wi, wo)) return vec3(0.0);
  vec3 h = halfVector(wi, wo);
  float sum = 0.0;
  int i = 0;
  do {
    Lobe lobe = lobeAt(i);
    sum += lobe.amount * densityOf(lobe, h) * geometryFactor(lobe.base, geometryAxis(e, lobe.mean), h, wi, wo);
  } while (++i < e.count);
  return fresnelTerm(f0, wi, wo) * sum;
}

// A lobe's mean direction times its share and the length of the mean of its facets' unit normals: |r| over that of a
// single facet.
vec3 meanNormalOf(vec4 lobe) { return min((1.0 - lobe.w) / max(1.0 - facet_shortfall, 1e-6), 1.0) * lobe.xyz; }

//? if diffuse
vec3 diffuse(Effective e, vec3 albedo, vec3 f0, vec3 wi, vec3 wo) {
//? if multi_lobe
  if (facet_lobe_count > 0) {
    float size = max(length(e.normal), 1e-6);
    return size * lambert(e.normal / size, albedo, f0, wi, wo);
  }
//? end
  vec3 sum = vec3(0.0);
  int i = 0;
  do {
    sum += lambert(meanNormalOf(lobes[i]), albedo, f0, wi, wo);
  } while (++i < e.count);
  return sum;
}
//? end

float ndf(Effective e, vec3 h) {
  float sum = 0.0;
  for (int i = 0; i < e.count; ++i) {
    Lobe lobe = lobeAt(i);
    sum += lobe.amount * densityOf(lobe, h);
  }
  return sum;
}

//? if environment_light
int lobeCount(Effective e) { return e.count; }

// What its facets cover, seen along their own normals, is what they reflect: the share, which is no integral of the
// density.
NormalLobe normalLobe(Effective e, int i) {
  Lobe lobe = lobeAt(i);
//? if lobe_base
  return baseNormalLobe(lobe.mean, lobe.base, lobe.share);
//? else
  return vmfNormalLobe(lobe.mean, lobe.kappa, lobe.share, lobe.base);
//? end
}

float lobeGeometry(Effective e, NormalLobe lobe, vec3 h, vec3 wi, vec3 wo) {
//? if multi_lobe
  if (facet_lobe_count > 0) return geometryFactor(lobe.base, geometryAxis(e, lobe.axis), h, wi, wo);
//? end
  return geometryFactor(lobe.base, lobe.axis, h, wi, wo);
}

vec3 meanNormal(Effective e) {
//? if multi_lobe
  if (facet_lobe_count > 0) return e.normal;
//? end
  vec3 sum = vec3(0.0);
  for (int i = 0; i < e.count; ++i) sum += meanNormalOf(lobes[i]);
  return sum;
}
//? end
