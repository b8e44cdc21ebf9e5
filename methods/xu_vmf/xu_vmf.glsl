// Xu, Wang, Zhao, Bao 2017: the effective BRDF is a mixture of von Mises-Fisher lobes, one for each part of the
// hemisphere of normals; each is recovered from its characteristic vector, which the texture filter averages.

// xu_vmf_conversion.glsl and xu_vmf_cells.glsl, behind this text.
float shortfallOf(float kappa);
float kappaOf(float q);
float kappaOfLobe(float lobe);
float lobeOfKappa(float kappa);
int cellOf(vec3 r);
int partOfCell(int cell);
int beyondPart(int part);

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

// A pixel's lobes, 0 to count - 1, with what all lights take of them: mean direction and width (the parameter of the base
// lobe, or kappa), and what the density and the cosine of the mean normal are multiplied by. Few numbers, since an array
// whose index is not known is dear to write and to read. They are no member of Effective, which functions take by value:
// a software renderer would copy them all at every call.
vec4 lobes[most_lobes];
vec2 weights[most_lobes];
//? if environment_light
float shares[most_lobes];  // of the footprint's facets, but as published
//? end

struct Effective {
  int count;
  float covered;  // of the footprint, by the lobes: what their weights are still to be divided by
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

struct Lobe {
  vec3 mean;
//? if not lobe_base
  float kappa;
//? end
  float base;    // the base lobe of that width
  float amount;  // what its density is multiplied by
};

Lobe lobeAt(int i) {
  vec4 lobe = lobes[i];
//? if lobe_base
  return Lobe(lobe.xyz, lobe.w, weights[i].x);
//? else
  return Lobe(lobe.xyz, lobe.w, lobeOfKappa(lobe.w), weights[i].x);
//? end
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

// The length of the mean of a lobe's facets' unit normals: |r| over that of a single facet.
float meanNormalLength(float q) { return min((1.0 - q) / max(1.0 - facet_shortfall, 1e-6), 1.0); }

// `amount` is what the lobe adds with as published: it is the share where lobes weigh what they cover.
void pushLobe(inout Effective e, vec3 mean, float q, float share, float amount) {
  float kappa = kappaOf(q);
  float base = lobeOfKappa(kappa);
//? if not variant_published
  amount = share;
//? end
//? if sampling_texel
  // The lobe of the one texel that was drawn is a facet's own. The roughness map may have drawn another.
  facet_shortfall = q;
  facet_energy = energyOf(base);
//? end
//? if lobe_base
  lobes[e.count] = vec4(mean, base);
//? else
  lobes[e.count] = vec4(mean, kappa);
//? end
  weights[e.count] = vec2(amount * facet_energy / energyOf(base), share * meanNormalLength(q));
//? if environment_light
  shares[e.count] = amount;
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
// to others. Each is (r, 1), or 0: the fourth channel needs no look.
mat4 texelsAbout(sampler2DArray map, vec3 middle) {
  vec4 x = textureGather(map, middle, 0);
  vec4 y = textureGather(map, middle, 1);
  vec4 z = textureGather(map, middle, 2);
  vec4 covered = vec4(notEqual(abs(x) + abs(y) + abs(z), vec4(0.0)));
  return transpose(mat4(x, y, z, covered));
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
  int layers = textureSize(xu_vmf_parts, 0).z / ownLobeCount();
  vec3 place = vec3(p.uv, p.own * layers + part);
  vec4 r = share * textureLod(xu_vmf_parts, place, p.level - 1.0);
  float least = 0.0;
//? if storage_fp16
//? if roughness_variation
  least = share * textureLod(xu_vmf_parts_guard, place, p.level - 1.0).r;
//? end
//? end
  int beyond = beyondPart(part);
  for (int i = 0; i < 4; ++i) {
    bool holds = part <= p.part[i] && p.part[i] < beyond;
    r += holds ? p.texel[i] : vec4(0.0);
    least += holds ? p.least[i] : 0.0;
  }
  return partOf(r, least);
}

//? if anisotropic
Part partUnder(Footprint f, int own, int part) {
  Probes p = probesOf(vec2(textureSize(xu_vmf_whole, 0).xy), f);
  vec4 r = vec4(0.0);
  float least = 0.0;
  for (int i = 0; i < p.count; ++i) {
    Part one = partAt(probeAt(own, probeUv(f, p, i), p.level), part);
    r += one.r;
    least += one.least;
  }
  return Part(r / float(p.count), least / float(p.count));
}
//? end

//? if j_adaptive
// How far one lobe serves a part: 1 wholly, 0 not at all. Algorithm 1 steps at the threshold. A cell is not cut, nor
// what nothing is in.
float unityOf(Part part, int i) {
  if (beyondPart(i) == i + 1 || part.r.w < least_share) return 1.0;
  float size = length(part.r.xyz) / part.r.w;
  float threshold = i == 0 ? option_eps0 : option_eps1;
//? if thresholds_blended
  return clamp((size - threshold) / 0.02 + 1.0, 0.0, 1.0);
//? else
  return size > threshold ? 1.0 : 0.0;
//? end
}
//? end

// The loop runs over the layers that the map has: a count that the compiler does not know, so that it unrolls nothing
// and compiles in a fraction of the time. It asks at its end: a software renderer runs a body that is asked for first
// once more than needed. It runs what a condition leaves out as well, but not a loop's further rounds: so every part is
// a round of its own, the whole hemisphere, which serves most footprints, the first, and a pixel goes on to what it
// needs next: the parts that this one is cut into, or those beyond it.
void addParts(inout Effective e, Footprint f, int own) {
  int layers = textureSize(xu_vmf_parts, 0).z / ownLobeCount();
//? if not anisotropic
  Probe probe = probeAt(own, f.uv, levelOf(vec2(textureSize(xu_vmf_whole, 0).xy), f));
//? end
//? if j_adaptive
//? if thresholds_blended
  float coarse_weight = 0.0;  // what the hemisphere leaves to the coarse parts, and such a part to its cells
  float cell_weight = 0.0;
//? end
//? end
  int i = 0;
  do {
//? if anisotropic
    Part part = partUnder(f, own, i);
//? else
    Part part = partAt(probe, i);
//? end
//? if j_adaptive
    float unity = unityOf(part, i);
    int beyond = beyondPart(i);
//? if thresholds_blended
    bool is_cell = beyond == i + 1;
    float weight = i == 0 ? 1.0 : is_cell ? cell_weight : coarse_weight;
    addLobe(e, part, weight * unity);
    if (!is_cell) cell_weight = weight * (1.0 - unity);
    if (i == 0) coarse_weight = 1.0 - unity;
//? else
    addLobe(e, part, unity);
//? end
    i = unity >= 1.0 ? beyond : i + 1;
//? else
    addLobe(e, part, 1.0);
    ++i;
//? end
  } while (i < layers);
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

// What the amounts are still to be divided by.
float amountsOf(Effective e) {
//? if variant_published
  return 1.0;
//? else
  return e.covered;
//? end
}

void addOwnLobe(inout Effective e, Footprints f, int k) {
  OwnLobe own = ownLobe(f, k);
  float q = shortfallOf(kappaOfLobe(own.parameter));
  facet_shortfall = q;
  facet_energy = energyOf(own.parameter);
  int first = e.count;
  pushLobe(e, own.axis, q, 1.0, 1.0);  // flat facets, unless others take their place
  e.count = first;
  e.covered = 0.0;
//? if texture_arrays
  addLobes(e, placeOf(f), k);
//? end
  if (e.count == first) {
    e.covered = 1.0;
    ++e.count;
  }
//? if multi_lobe
  // Each of the facets' lobes has parts of its own, which cover what they cover.
  int i = first;
  do {
    weights[i] *= own.weight / vec2(amountsOf(e), e.covered);
//? if environment_light
    shares[i] *= own.weight / amountsOf(e);
//? end
  } while (++i < e.count);
  e.covered = 1.0;
//? end
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

//? if diffuse
float last_cosine;  // of the facets' unit normals with the light, their mean: found by `specular`, for `diffuse` after it
//? end

// One loop for both terms: a lobe is dear to read.
vec3 specular(Effective e, vec3 f0, vec3 wi, vec3 wo) {
  vec3 h = halfVector(wi, wo);
  float sum = 0.0;
//? if diffuse
  float cosine = 0.0;
//? end
  int i = 0;
  do {
    Lobe lobe = lobeAt(i);
    sum += lobe.amount * densityOf(lobe, h) * geometryFactor(lobe.base, geometryAxis(e, lobe.mean), h, wi, wo);
//? if diffuse
    cosine += weights[i].y * max(dot(lobe.mean, wi), 0.0);
//? end
  } while (++i < e.count);
//? if diffuse
  last_cosine = cosine / e.covered;
//? end
  if (!halfVectorIsDefined(wi, wo)) return vec3(0.0);
  return fresnelTerm(f0, wi, wo) * (sum / amountsOf(e));
}

//? if diffuse
vec3 diffuse(Effective e, vec3 albedo, vec3 f0, vec3 wi, vec3 wo) {
//? if multi_lobe
  if (facet_lobe_count > 0) {
    float size = max(length(e.normal), 1e-6);
    return size * lambert(e.normal / size, albedo, f0, wi, wo);
  }
//? end
  return lambert(last_cosine * wi, albedo, f0, wi, wo);  // any normal of that cosine with the light
}
//? end

float ndf(Effective e, vec3 h) {
  float sum = 0.0;
  for (int i = 0; i < e.count; ++i) {
    Lobe lobe = lobeAt(i);
    sum += lobe.amount * densityOf(lobe, h);
  }
  return sum / amountsOf(e);
}

//? if environment_light
int lobeCount(Effective e) { return e.count; }

// What its facets cover, seen along their own normals, is what they reflect: the share, which is no integral of the
// density.
NormalLobe normalLobe(Effective e, int i) {
  Lobe lobe = lobeAt(i);
//? if lobe_base
  return baseNormalLobe(lobe.mean, lobe.base, shares[i] / amountsOf(e));
//? else
  return vmfNormalLobe(lobe.mean, lobe.kappa, shares[i] / amountsOf(e), lobe.base);
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
  for (int i = 0; i < e.count; ++i) sum += weights[i].y * lobes[i].xyz;
  return sum / e.covered;
}
//? end
