// Xu, Wang, Zhao, Bao 2017: the effective BRDF is a mixture of von Mises-Fisher lobes, one for each part of the
// hemisphere of normals; each is recovered from its characteristic vector, which the texture filter averages.

// xu_vmf_conversion.glsl, behind this text.
float shortfallOf(float kappa);
float kappaOf(float q);
float kappaOfLobe(float lobe);
float lobeOfKappa(float kappa);

//? if j_1
const int most_lobes = 1;
//? else
//? if j_4
const int most_lobes = 4;
//? else
const int most_lobes = 8;
//? end
//? end

// Lobes 0 to count - 1.
struct Effective {
  int count;
  vec3 mean[most_lobes];
  float kappa[most_lobes];
  float lobe[most_lobes];    // the base lobe of that width
  float share[most_lobes];   // of the footprint; all sum to one
  float cosine[most_lobes];  // length of the mean of the unit normals
};

// A part that covers less of the footprint is left out, and no division is by nothing.
const float least_share = 1e-4;

//? if lobe_vmf
//? if not distribution_vmf
//? include vmf_density.glsl
//? end
//? end

float densityOf(Effective e, int i, vec3 h) {
//? if lobe_base
  return lobeDensity(e.lobe[i], e.mean[i], h);
//? else
//? if distribution_vmf
  return lobeDensity(e.kappa[i], e.mean[i], h);
//? else
  return vmfDensity(e.kappa[i], e.mean[i], h);
//? end
//? end
}

// What a lobe adds with. Algorithm 1 as printed adds every lobe whole, whatever it covers.
float weightOf(Effective e, int i) {
//? if variant_published
  return 1.0;
//? else
  return e.share[i];
//? end
}

void addFlat(inout Effective e) {
  e.mean[0] = vec3(0.0, 0.0, 1.0);
  e.lobe[0] = lobe_cutoff.x;
  e.kappa[0] = kappaOfLobe(lobe_cutoff.x);
  e.share[0] = 1.0;
  e.cosine[0] = 1.0;
  e.count = 1;
}

// The lobe of a part (w r, w).
void addLobe(inout Effective e, vec4 part) {
  if (part.w < least_share) return;
  vec3 r = part.xyz / part.w;
  float size = length(r);
  int i = e.count++;
  e.mean[i] = size < 1e-6 ? vec3(0.0, 0.0, 1.0) : r / size;
  e.kappa[i] = kappaOf(clamp(1.0 - size, 1.0 / largest_exponent, 1.0));  // rounding can leave |r| of 1 and above
  e.lobe[i] = lobeOfKappa(e.kappa[i]);
  e.share[i] = part.w;
//? if roughness_variation
  e.cosine[i] = 1.0;  // what of |r| is the normals' and what the lobes' is not known
//? else
  float own = 1.0 - shortfallOf(kappaOfLobe(lobe_cutoff.x));  // |r| of a single facet
  e.cosine[i] = min(size / max(own, 1e-6), 1.0);
//? end
}

bool concentrated(vec4 part, float threshold) { return length(part.xyz) > threshold * part.w; }

//? if normal_variation
int layerCount() { return textureSize(xu_vmf_map, 0).z; }
vec4 partOf(int layer, Footprints f) { return fetch(xu_vmf_map, layer, f.normal); }
//? else
//? if roughness_variation
int layerCount() { return textureSize(xu_vmf_map, 0).z; }
vec4 partOf(int layer, Footprints f) { return fetch(xu_vmf_map, layer, f.roughness); }
//? else
int layerCount() { return 0; }
vec4 partOf(int layer, Footprints f) { return vec4(0.0); }
//? end
//? end

// Loops run over the layers that the map has: a count that the compiler does not know, so that it unrolls nothing and
// compiles in a fraction of the time.
void addParts(inout Effective e, Footprints f) {
//? if j_adaptive
  // Algorithm 1. A coarse cell is the sum of its two fine ones, so that it needs no layer of its own.
  vec4 whole = partOf(0, f);
  if (whole.w < least_share) return;
  if (concentrated(whole, option_eps0)) {
    addLobe(e, whole);
    return;
  }
  int layers = layerCount();
  for (int i = 1; i < layers; i += 2) {
    vec4 first = partOf(i, f);
    vec4 second = partOf(i + 1, f);
    if (concentrated(first + second, option_eps1)) {
      first += second;
      second = vec4(0.0);
    }
    addLobe(e, first);
    addLobe(e, second);
  }
//? else
  int layers = layerCount();
  for (int i = 0; i < layers; ++i) addLobe(e, partOf(i, f));
//? end
}

Effective effective(Footprints f) {
  Effective e;
  e.count = 0;
  addParts(e, f);
  if (e.count == 0) addFlat(e);
  float covered = 0.0;
  for (int i = 0; i < e.count; ++i) covered += e.share[i];
  for (int i = 0; i < e.count; ++i) e.share[i] /= covered;
  return e;
}

vec3 specular(Effective e, vec3 f0, vec3 wi, vec3 wo) {
  if (!halfVectorIsDefined(wi, wo)) return vec3(0.0);
  vec3 h = halfVector(wi, wo);
  float sum = 0.0;
  for (int i = 0; i < e.count; ++i) {
    sum += weightOf(e, i) * densityOf(e, i, h) * geometryFactor(e.lobe[i], e.mean[i], h, wi, wo);
  }
  return fresnelTerm(f0, wi, wo) * sum;
}

//? if diffuse
vec3 diffuse(Effective e, vec3 albedo, vec3 f0, vec3 wi, vec3 wo) {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < e.count; ++i) sum += e.share[i] * e.cosine[i] * lambert(e.mean[i], albedo, f0, wi, wo);
  return sum;
}
//? end

float ndf(Effective e, vec3 h) {
  float sum = 0.0;
  for (int i = 0; i < e.count; ++i) sum += weightOf(e, i) * densityOf(e, i, h);
  return sum;
}
