// Components with a full covariance over the disc (option covariance=full). A texel stores weight, first and second
// moments of each component, which reflects with the base lobe, stretched to its covariance.
#if NORMAL_VARIATION
const int parts = int(option_n);
#else
const int parts = 1;
#endif
const int part_channels = 6;
const bool fast_density = true;
#include "stretched_part.glsl"
#include "parts_module.glsl"
#include "even_parts.glsl"

BaseLobe lobeOfFacets(Footprints f) {
#if ROUGHNESS_VARIATION
  float variance = facetVariance(f);
  return BaseLobe(lobeFromVariance(variance), variance);
#else
  return baseLobe(f);
#endif
}

#if NORMAL_VARIATION
// Converts from the disc of (n_x, n_y) to stereographic coordinates, linearly about the mean. Lengths along the tilt
// are cosine times those on the sphere, lengths across it are equal, and lengths on the plane are (1 + |p|^2) / 2 times
// those on the sphere. On the rim a component keeps its width along the tilt over the disc.
Part partOverDisc(float share, vec2 mean, vec3 spread, BaseLobe base) {
  float size2 = dot(mean, mean);
  if (size2 > 1.0) mean *= inversesqrt(size2);
  float height = sqrt(max(1.0 - size2, 0.0));
  vec2 tilt = size2 > 1e-12 ? mean * inversesqrt(size2) : vec2(1.0, 0.0);
  mat2 covariance = mat2(spread.x, spread.y, spread.y, spread.z);
  float along = dot(tilt, covariance * tilt);
  float stretch = 1.0 / max(height, sqrt(sqrt(max(along, 1e-12))));
  mat2 to_sphere = mat2(1.0) + (stretch - 1.0) * outerProduct(tilt, tilt);
  vec2 p = mean / (1.0 + height);
  float scale = 0.5 * (1.0 + dot(p, p));
  mat2 over_plane = scale * scale * (to_sphere * covariance * to_sphere);
  return stretchedPart(share, p, vec3(over_plane[0][0], over_plane[0][1], over_plane[1][1]), base.parameter,
                       base.variance);
}

void fillParts(inout Effective e, Footprints f) {
  Moments moments[parts];
  float covered = fetchMoments(tan_gmm_moments, f.normal, moments);
  BaseLobe base = lobeOfFacets(f);
  if (covered <= 0.0) {
    moments[0] = Moments(vec3(1.0, 0.0, 0.0), vec3(0.0));
    covered = 1.0;
  }
  e.mean_normal = vec3(0.0);
  for (int i = 0; i < parts; ++i) {
    Moments m = moments[i];
    if (m.first.x < least_share * covered) {
      e.part[i] = absentPart();
      continue;
    }
    vec2 mean = m.first.yz / m.first.x;
    e.part[i] = partOverDisc(m.first.x / covered, mean, covarianceOf(mean, m.second / m.first.x), base);
    e.mean_normal += e.part[i].share * e.part[i].axis;
  }
#if DIFFUSE && SPECULAR_JOINT && SPECULAR_VARIATION
  e.mean_normal = fetch(tan_gmm_normal, f.normal).xyz;  // by area, because the colours weigh the parts
#endif
}
#endif

Effective effective(Footprints f) {
  Effective e;
#if NORMAL_VARIATION
  fillParts(e, f);
#else
  BaseLobe base = lobeOfFacets(f);
  e.mean_normal = vec3(0.0, 0.0, 1.0);
  e.part[0] = stretchedPart(1.0, vec2(0.0), vec3(0.0), base.parameter, base.variance);
#endif
  return e;
}
