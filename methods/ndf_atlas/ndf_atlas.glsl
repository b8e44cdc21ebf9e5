// From one level on, tables of the density of normals over the half vector, if normals differ enough. Otherwise moments
// of a few parts of the normals, with one stretched base lobe per part (methods/ndf_atlas/README.md).
#if NORMAL_VARIATION
const int parts = int(option_k);
#else
const int parts = 1;
#endif
const int part_channels = 6;
const bool fast_density = true;
#include "stretched_part.glsl"
#include "part_moments.glsl"
#if NORMAL_VARIATION
#include "mean_normal.glsl"
#endif

#if NORMAL_VARIATION && SAMPLING_FRAME
#include "ndf_atlas_tables.glsl"
#endif

struct Effective {
  Part part[parts];
  float lobe_share;   // share of the parts; the rest is that of the tables
  float table_share;  // over the coverage of the texels that have tables
#if NORMAL_VARIATION && SAMPLING_FRAME
  Tables tables;
#endif
  float narrowing;    // how far the mean normal of facets that reflect to h is on the way to h
  float lobe;         // of a facet
  vec3 axis;          // of the mean normal
  vec3 mean_normal;   // not renormalised: its dot product is the mean of the texels'
};

#if NORMAL_VARIATION && SAMPLING_FRAME
// The shares of tables and lobes, by the ratio of spread and lobe. A lobe is exact where normals agree, and a table is
// off by a hundredth everywhere.
const vec2 tabulated_ratio = vec2(0.2, 0.4);

// `ratio`: the slope variance of the normals over that of a facet's lobe.
void fillTables(inout Effective e, Footprint f, float ratio) {
  ivec2 finest = textureSize(ndf_atlas_moments, 0).xy;
  Probes p = probesOf(vec2(finest), f);
  float share = clamp(p.level - ndf_atlas_level + 1.0, 0.0, 1.0) *
                clamp((ratio - tabulated_ratio.x) / (tabulated_ratio.y - tabulated_ratio.x), 0.0, 1.0);
  float covered = findTables(f, finest, p, e.tables);
  if (share <= 0.0 || covered <= 0.0) {
#if !FIXED_TRIPS
    e.tables.probes.count = 0;  // not a constant: compilers would not unroll the loops over lights
#endif
    return;
  }
  e.table_share = share / covered;
  e.lobe_share = 1.0 - share;
}
#endif

#if LOBES_LISTED
const float whole_chain = 100.0;  // coarser than any level; the sampler of the moments has levels only
Part surrounded[parts];  // of the whole footprint, with or without tables
#endif

#if NORMAL_VARIATION
Part partOf(Moments m, int i, float covered, BaseLobe base) {
  if (m.first.x < least_share * covered) return absentPart();
  vec2 mean = m.first.yz / m.first.x;
  vec3 spread = covarianceOf(mean, m.second / m.first.x);
  return stretchedPart(m.first.x / covered, ndf_atlas_centres[i] + mean, spread, base.parameter, base.variance);
}

void fillParts(Footprints f, float coarsest, BaseLobe base, out Part part[parts]) {
  Moments moments[parts];
  float covered = fetchMoments(ndf_atlas_moments, f.normal, coarsest, moments);
  if (covered <= 0.0) {
    moments[0] = Moments(vec3(1.0, -ndf_atlas_centres[0]), vec3(0.0));
    covered = 1.0;
  }
  for (int i = 0; i < parts; ++i) part[i] = partOf(moments[i], i, covered, base);
}

void fillTexels(inout Effective e, Footprints f, BaseLobe base) {
  vec4 normal = meanNormal(f);  // direction, length
  e.axis = normal.xyz;
  e.mean_normal = normal.xyz * normal.w;
  float ratio = (1.0 - normal.w) / (max(normal.w, 1e-3) * base.variance);  // slope variance of the normals over that of the lobe
  e.narrowing = ratio / (1.0 + ratio);
#if SAMPLING_FRAME
  fillTables(e, f.normal, ratio);
  fillParts(f, ndf_atlas_level - 1.0, base, e.part);
#else
  fillParts(f, any_level, base, e.part);
#endif
#if LOBES_LISTED
  fillParts(f, whole_chain, base, surrounded);
#endif
}
#endif

Effective effective(Footprints f) {
  Effective e;
  BaseLobe base = baseLobe(f);
  e.lobe = base.parameter;
  e.lobe_share = 1.0;
  e.table_share = 0.0;
  e.narrowing = 0.0;
  e.axis = vec3(0.0, 0.0, 1.0);
  e.mean_normal = vec3(0.0, 0.0, 1.0);
#if NORMAL_VARIATION
  fillTexels(e, f, base);
#else
  e.part[0] = stretchedPart(1.0, vec2(0.0), vec3(0.0), base.parameter, base.variance);
#if LOBES_LISTED
  surrounded[0] = e.part[0];
#endif
#endif
  return e;
}

float tabulatedDensity(Effective e, vec3 h) {
#if NORMAL_VARIATION && SAMPLING_FRAME
  return e.table_share * tableSum(e.tables, h);
#else
  return 0.0;
#endif
}

float ndf(Effective e, vec3 h) {
  Direction at = directionOf(h);
  float sum = 0.0;
  for (int i = 0; i < parts; ++i) sum += partDensity(e.part[i], at);
  return e.lobe_share * sum + tabulatedDensity(e, h);
}

// The geometry factor is that of single facets: about the mean of a part, or about the expected normal of facets that
// reflect to h. For normals of spread S about the mean, under lobes of variance v, that is S / (S + v) of the way to h.
float reflectedDensity(Effective e, vec3 h, vec3 wi, vec3 wo) {
  Direction at = directionOf(h);
  float sum = 0.0;
  for (int i = 0; i < parts; ++i)
    sum += partDensity(e.part[i], at) * baseGeometry(e.part[i].lobe, e.part[i].axis, h, wi, wo);
  vec3 facing = normalize(mix(e.axis, h, e.narrowing));
  return e.lobe_share * sum + tabulatedDensity(e, h) * baseGeometry(e.lobe, facing, h, wi, wo);
}

vec3 meanNormal(Effective e) { return e.mean_normal; }

#include "density_module.glsl"

#if LOBES_LISTED
int lobeCount(Effective e) { return parts * lobes_per_part; }

NormalLobe normalLobe(Effective e, int i) { return partLobe(surrounded[i / lobes_per_part], i % lobes_per_part); }

float lobeGeometry(Effective e, NormalLobe lobe, vec3 h, vec3 wi, vec3 wo) {
  return baseGeometry(lobe.base, lobe.normal, h, wi, wo);
}
#endif
