// Weight, mean and covariance of each part of the normals under a footprint, from moments that the texture filter may
// average, and one stretched base lobe a part (methods/cells/README.md).
//? if coordinates_slopes
//? include slope_part.glsl
//? else
//? include stretched_part.glsl
//? end

//? if normal_variation
const int parts = int(option_k);
//? else
const int parts = 1;
//? end

//? include parts_module.glsl

//? if normal_variation
vec2 centreOf(int i) {
  vec2 centres[8] = vec2[8](vec2(cells_centre_x0, cells_centre_y0), vec2(cells_centre_x1, cells_centre_y1),
                            vec2(cells_centre_x2, cells_centre_y2), vec2(cells_centre_x3, cells_centre_y3),
                            vec2(cells_centre_x4, cells_centre_y4), vec2(cells_centre_x5, cells_centre_y5),
                            vec2(cells_centre_x6, cells_centre_y6), vec2(cells_centre_x7, cells_centre_y7));
  return centres[i];
}

void setPart(inout Effective e, int i, float covered, Moments m, BaseLobe base) {
  if (m.first.x < least_share * covered) {
    e.part[i] = absentPart();
    return;
  }
  vec2 mean = m.first.yz / m.first.x;
  vec3 spread = covarianceOf(mean, m.second / m.first.x);
  e.part[i] = stretchedPart(m.first.x / covered, centreOf(i) + mean, spread, base.parameter, base.variance);
}

// That of the smallest alpha of a material, 0.001. In 16 bits the weighted variance of a small part of polished facets
// rounds to 0, which no lobe has.
const float least_variance = 5e-7;

// The base lobe over a part: where the roughness map lies on the normals, the mean of the part's own texels.
BaseLobe lobeOfPart(BaseLobe shared_lobe, float weight, float weighted_variance) {
//? if roughness_variation and roughness_joint
  if (cells_joint > 0.5 && weight > 0.0) {
    float variance = max(weighted_variance / weight * stored_lobe_variance, least_variance);
    return BaseLobe(lobeFromVariance(variance), variance);
  }
//? end
  return shared_lobe;
}

void fillParts(inout Effective e, Footprints f) {
  Moments moments[parts];  // about the part's centre
  float covered = fetchMoments(cells_moments, f.normal, moments);
  BaseLobe base = baseLobe(f);
  if (covered <= 0.0) {
    moments[0] = Moments(vec3(1.0, -centreOf(0)), vec3(0.0));
    covered = 1.0;
  }
//? if roughness_variation and roughness_joint
  vec4 variances[2] = vec4[2](fetch(cells_variance, 0, f.normal), vec4(0.0));
  if (parts > 4) variances[1] = fetch(cells_variance, 1, f.normal);
//? end
  for (int i = 0; i < parts; ++i) {
//? if roughness_variation and roughness_joint
    setPart(e, i, covered, moments[i], lobeOfPart(base, moments[i].first.x, variances[i / 4][i % 4]));
//? else
    setPart(e, i, covered, moments[i], base);
//? end
  }
}
//? end

Effective effective(Footprints f) {
  Effective e;
  e.mean_normal = vec3(0.0, 0.0, 1.0);
//? if normal_variation
  fillParts(e, f);
//? if diffuse
  e.mean_normal = fetch(cells_normal, f.normal).xyz;
//? end
//? else
  BaseLobe base = baseLobe(f);
  e.part[0] = stretchedPart(1.0, vec2(0.0), vec3(0.0), base.parameter, base.variance);
//? end
  return e;
}
