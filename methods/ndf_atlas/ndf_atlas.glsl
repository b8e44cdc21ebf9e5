// Tables of the density of normals over the half vector, from a level on and where normals differ by enough; else
// moments of a few parts of the normals with a stretched base lobe each (methods/ndf_atlas/README.md).
//? if normal_variation
const int parts = int(option_k);
//? else
const int parts = 1;
//? end
const int part_channels = 6;
//? include stretched_part.glsl
//? include part_moments.glsl
//? if normal_variation
//? include mean_normal.glsl
//? end

//? if normal_variation and sampling_frame
//? include ndf_atlas_tables.glsl
//? end

struct Effective {
  Part part[parts];
  float lobe_share;   // of the parts, beside that of the tables
  float table_share;  // over what is covered by the texels that have tables
//? if normal_variation and sampling_frame
  Tables tables;
//? end
  float narrowing;    // of facets that reflect to h: how far their mean normal is on the way to h
  float lobe;         // a facet's own
  vec3 axis;          // of the mean normal
  vec3 mean_normal;   // not renormalised: its dot product is the mean of the texels' own
};

//? if normal_variation and sampling_frame
// Shares of the tables where spread and lobe are far from each other or alike: a lobe is exact where normals agree, and
// a table is off by a hundredth whatever they do.
const vec2 tabulated_ratio = vec2(0.2, 0.4);

// `ratio` is that of the normals' slope variance to a facet's lobe's.
void fillTables(inout Effective e, Footprint f, float ratio) {
  ivec2 finest = textureSize(ndf_atlas_moments, 0).xy;
  Probes p = probesOf(vec2(finest), f);
  float share = clamp(p.level - ndf_atlas_level + 1.0, 0.0, 1.0) *
                clamp((ratio - tabulated_ratio.x) / (tabulated_ratio.y - tabulated_ratio.x), 0.0, 1.0);
  float covered = findTables(f, finest, p, e.tables);
  if (share <= 0.0 || covered <= 0.0) {
    e.tables.probes.count = 0;
    return;
  }
  e.table_share = share / covered;
  e.lobe_share = 1.0 - share;
}
//? end

//? if environment_light
const float whole_chain = 100.0;  // no level is as coarse; the moments' sampler knows levels alone, no footprints
Part surrounded[parts];  // of the whole footprint, whatever has tables
//? end

//? if normal_variation
vec2 centreOf(int i) {
  vec2 centres[4] =
      vec2[4](vec2(ndf_atlas_centre_x0, ndf_atlas_centre_y0), vec2(ndf_atlas_centre_x1, ndf_atlas_centre_y1),
              vec2(ndf_atlas_centre_x2, ndf_atlas_centre_y2), vec2(ndf_atlas_centre_x3, ndf_atlas_centre_y3));
  return centres[i];
}

Part partOf(Moments m, int i, float covered, BaseLobe base) {
  if (m.first.x < least_share * covered) return absentPart();
  vec2 mean = m.first.yz / m.first.x;
  vec3 spread = covarianceOf(mean, m.second / m.first.x);
  return stretchedPart(m.first.x / covered, centreOf(i) + mean, spread, base.parameter, base.variance);
}

void fillParts(Footprints f, float coarsest, BaseLobe base, out Part part[parts]) {
  Moments moments[parts];
  float covered = fetchMoments(ndf_atlas_moments, f.normal, coarsest, moments);
  if (covered <= 0.0) {
    moments[0] = Moments(vec3(1.0, -centreOf(0)), vec3(0.0));
    covered = 1.0;
  }
  for (int i = 0; i < parts; ++i) part[i] = partOf(moments[i], i, covered, base);
}

void fillTexels(inout Effective e, Footprints f, BaseLobe base) {
  vec4 normal = meanNormal(f);  // direction, length
  e.axis = normal.xyz;
  e.mean_normal = normal.xyz * normal.w;
  float ratio = (1.0 - normal.w) / (max(normal.w, 1e-3) * base.variance);  // the normals' slope variance to the lobe's
  e.narrowing = ratio / (1.0 + ratio);
//? if sampling_frame
  fillTables(e, f.normal, ratio);
  fillParts(f, ndf_atlas_level - 1.0, base, e.part);
//? else
  fillParts(f, any_level, base, e.part);
//? end
//? if environment_light
  fillParts(f, whole_chain, base, surrounded);
//? end
}
//? end

Effective effective(Footprints f) {
  Effective e;
  BaseLobe base = baseLobe(f);
  e.lobe = base.parameter;
  e.lobe_share = 1.0;
  e.table_share = 0.0;
  e.narrowing = 0.0;
  e.axis = vec3(0.0, 0.0, 1.0);
  e.mean_normal = vec3(0.0, 0.0, 1.0);
//? if normal_variation
  fillTexels(e, f, base);
//? else
  e.part[0] = stretchedPart(1.0, vec2(0.0), vec3(0.0), base.parameter, base.variance);
//? if environment_light
  surrounded[0] = e.part[0];
//? end
//? end
  return e;
}

float tabulatedDensity(Effective e, vec3 h) {
//? if normal_variation and sampling_frame
  return e.table_share * tableSum(e.tables, h);
//? else
  return 0.0;
//? end
}

float ndf(Effective e, vec3 h) {
  Direction at = directionOf(h);
  float sum = 0.0;
  for (int i = 0; i < parts; ++i) sum += partDensity(e.part[i], at);
  return e.lobe_share * sum + tabulatedDensity(e, h);
}

// The geometry is that of single facets: about a part's mean, or about the normal to be expected of those that reflect
// to h. Of normals with a spread S about the mean, under lobes of variance v, that is S / (S + v) of the way to h.
float reflectedDensity(Effective e, vec3 h, vec3 wi, vec3 wo) {
  Direction at = directionOf(h);
  float sum = 0.0;
  for (int i = 0; i < parts; ++i)
    sum += partDensity(e.part[i], at) * geometryFactor(e.part[i].lobe, e.part[i].axis, h, wi, wo);
  vec3 facing = normalize(mix(e.axis, h, e.narrowing));
  return e.lobe_share * sum + tabulatedDensity(e, h) * geometryFactor(e.lobe, facing, h, wi, wo);
}

Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo) {
  Reflected r;
  r.specular = vec3(0.0);
  if (halfVectorIsDefined(wi, wo))
    r.specular = fresnelTerm(s.f0, wi, wo) * reflectedDensity(e, halfVector(wi, wo), wi, wo);
//? if diffuse
  r.diffuse = diffuse(e.mean_normal, s, wi, wo);
//? end
  return r;
}

//? if environment_light
int lobeCount(Effective e) { return parts; }

// A round lobe of the same mean slope variance.
NormalLobe normalLobe(Effective e, int i) {
  NormalLobe lobe = baseNormalLobe(surrounded[i].axis, lobeFromVariance(surrounded[i].breadth), surrounded[i].share);
  lobe.base = surrounded[i].lobe;
  return lobe;
}

float lobeGeometry(Effective e, NormalLobe lobe, vec3 h, vec3 wi, vec3 wo) {
  return geometryFactor(lobe.base, lobe.axis, h, wi, wo);
}

vec3 meanNormal(Effective e) { return e.mean_normal; }
//? end
