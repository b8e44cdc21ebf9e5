// Environment light: each lobe of normals and each lobe of the facets' BRDF combine to one lobe over half vectors
// (equation 14). lobeReflectance has the factor of the pair of directions, and visibleFacets the diffuse term.

#if LOBE_BASE
int baseLobeCount() { return 1; }
#else
int baseLobeCount() { return textureSize(iwasaki_brdf, 0).x; }
#endif

#if TABULATED_BRDF
int ownLobeCount() { return iwasaki_tabulated > 0.5 ? textureSize(iwasaki_table, 0).x - 1 : baseLobeCount(); }
vec4 tabulatedLobe(int s) { return texelFetch(iwasaki_table, ivec2(s + 1, 0), 0); }  // lobe 0 is the diffuse term
#else
int ownLobeCount() { return baseLobeCount(); }
#endif

int lobeCount(Effective e) { return e.count * ownLobeCount(); }

// A spherical Gaussian of the facets' BRDF, convolved with a lobe of normals.
NormalLobe convolvedLobe(vec4 normals, float sharpness, float share) {
  return vmfNormalLobe(normals.xyz, normals.w * (sharpness / (normals.w + sharpness)), share, lobe_cutoff.x);
}

NormalLobe normalLobe(Effective e, int i) {
  int own = ownLobeCount();
  int j = i / own;
  vec4 lobe = lobeOf(j);
#if MICROGEOMETRY_VISIBILITY
  float share = 1.0;  // the table stores the visible share of a pair of directions
#else
  float share = shareOf(j);
#endif
#if TABULATED_BRDF
  if (iwasaki_tabulated > 0.5) {
    float sharpness = tabulatedLobe(i % own).x;
    return convolvedLobe(lobe, sharpness, share * sgIntegral(sharpness));
  }
#endif
#if LOBE_BASE
  return baseNormalLobe(lobe.xyz, lobeFromVariance(lobeVariance(lobe_cutoff.x) + 1.0 / lobe.w), share);
#else
  vec2 brdf = texelFetch(iwasaki_brdf, ivec2(i % own, 0), 0).xy;
  return convolvedLobe(lobe, brdf.x, share * brdf.y * sgIntegral(brdf.x));
#endif
}

#if MICROGEOMETRY_VISIBILITY
// The mean height of the part of a vMF lobe above the horizon: that of a Gaussian in the plane tangent to the sphere at
// the lobe's centre. At the zenith it is the mean cosine to the axis.
float meanHeight(float height, float sharpness) {
  float deviation = sqrt(max(1.0 - height * height, 0.0) / sharpness);
  if (deviation < 1e-4) return max(height, 0.0) * meanCosine(sharpness);
  float a = max(height / deviation, -5.0);
  float mean = height + deviation * inverse_root_two_pi * exp(-0.5 * a * a) / max(normalCdf(a), 1e-7);
  return max(mean, 0.0) * mix(1.0, meanCosine(sharpness), clamp(height, 0.0, 1.0));
}

// The factor on the lobe's density in f cos, in colour, with the amplitude of its pair of directions. The table stores
// the facets' cosine to the light divided by that of the surface, of which this takes the mean over the lobe.
vec3 lobeReflectance(Effective e, int i, vec3 f0, vec3 h, vec3 wi, vec3 wo, float sharpness) {
  int own = ownLobeCount();
  int j = i / own;
  vec3 amplitude = tableAt(j, tableTexels(wi, wo));
#if TABULATED_BRDF
  if (iwasaki_tabulated > 0.5) {
    return amplitude * tabulatedLobe(i % own).yzw * riseOf(h, wi) * meanHeight(wi.z, sharpness);
  }
#endif
#if COSINES_PUBLISHED
  return fresnelTerm(f0, wi, wo) * amplitude * meanHeight(wi.z, sharpness);
#else
  return fresnelTerm(f0, wi, wo) * amplitude * smoothFactor(lobeOf(j), h, wi, wo);
#endif
}

#if ENVIRONMENT_DIFFUSE
// The diffuse term of the facets that a viewer sees: its reflectance under a constant environment, and a mean normal
// with about their irradiance.
DiffuseFacets visibleFacets(Effective e, vec3 wo) {
  float side = option_directions;
  vec2 uv = clamp(hemisphereToSquare(wo) * side, 0.5, side - 0.5) / side;
  vec3 share = textureLod(iwasaki_diffuse, vec3(uv, 0.0), 0.0).rgb;
  vec3 mean_normal = textureLod(iwasaki_diffuse, vec3(uv, 1.0), 0.0).xyz;
#if TABULATED_BRDF
  if (iwasaki_tabulated > 0.5) {
    return DiffuseFacets(mean_normal, share * pi * texelFetch(iwasaki_table, ivec2(0), 0).yzw, true);
  }
#endif
#if DIFFUSE
  return DiffuseFacets(mean_normal, share, false);
#else
  return DiffuseFacets(mean_normal, vec3(0.0), false);  // only tables have a diffuse term here
#endif
}
#endif
#else
// The lobe of a NormalLobe, found by its axis.
int lobeAbout(Effective e, vec3 axis) {
  int nearest = 0;
  for (int j = 1; j < e.count; ++j) {
    if (dot(lobeOf(j).xyz, axis) > dot(lobeOf(nearest).xyz, axis)) nearest = j;
  }
  return nearest;
}

float lobeGeometry(Effective e, NormalLobe lobe, vec3 h, vec3 wi, vec3 wo) {
  return smoothFactor(lobeOf(lobeAbout(e, lobe.axis)), h, wi, wo);
}

vec3 meanNormal(Effective e) {
  vec3 sum = vec3(0.0);
  for (int j = 0; j < e.count; ++j) sum += shareOf(j) * meanCosine(lobeOf(j).w) * lobeOf(j).xyz;
  return sum;
}
#endif

#if ENVIRONMENT_SUMMED
vec3 environmentLit(Effective e, Surface s, vec3 wo, mat3 frame);  // environment_stack.glsl
#if ENVIRONMENT_GAUSSIANS && DIFFUSE && !TABULATED_BRDF
vec3 environmentSpecular(Effective e, vec3 f0, vec3 wo, mat3 frame);
#if ENVIRONMENT_VISIBILITY
float visibleElevation(vec3 direction, float elevation);
#endif

// The diffuse term under Gaussians of light, each from its axis (after equation 16). What is visible of one is the share
// of a Gaussian beyond the nearest edge, as far as that is from the axis (Wang et al. 2009); the horizon is an edge too.
vec3 gaussianDiffuse(Effective e, Surface s, vec3 wo, mat3 frame) {
  vec3 sum = vec3(0.0);
  int count = textureSize(iwasaki_environment, 0).x;
  int k = 0;
  do {
    countLookups(2);
    vec4 gaussian = texelFetch(iwasaki_environment, ivec2(k, 0), 0);
    vec3 light = texelFetch(iwasaki_environment, ivec2(k, 1), 0).rgb;
    vec3 wi = gaussian.xyz * frame;
    if (wi.z <= 0.0) continue;
    float height = wi.z;
#if ENVIRONMENT_VISIBILITY
    height = visibleElevation(gaussian.xyz, height);
#endif
    float visible = normalCdf(asin(clamp(height, -1.0, 1.0)) * sqrt(gaussian.w));
    sum += visible * light * meanDiffuse(e, s, wi, wo);
  } while (++k < count);
  return sum;
}

vec3 environmentSum(Effective e, Surface s, vec3 wo, mat3 frame) {
  return environmentSpecular(e, s.f0, wo, frame) + gaussianDiffuse(e, s, wo, frame);
}
#else
vec3 environmentSum(Effective e, Surface s, vec3 wo, mat3 frame) { return environmentLit(e, s, wo, frame); }
#endif
#endif
