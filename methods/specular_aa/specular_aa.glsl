// Engines' screen-space filters of normals; tests/methods/screen_presets.hpp has the same formulas in double precision.
// Without neighbouring pixels (a sample of a supersampled image, the NDF inspector) the lobe is not widened.
#include "mean_normal.glsl"
#include "mean_roughness.glsl"
#if !BAKE_NONE
#include "baked_roughness.glsl"
#endif

#if PRESET_TOKUYOSHI_KAPLANYAN_2019 || PRESET_TOKUYOSHI_KAPLANYAN_2021
// Tokuyoshi and Kaplanyan 2019, 2021: half vectors of a light spread over the pixel, in the frame of the normal, and
// the lobe takes their covariance. Matrices are alpha^2, twice the covariance of slopes.
#include "facet_frame.glsl"

// The part of a half vector that is spread: its slope in 2019, its projection on the disc in 2021.
vec2 spreadOf(vec3 h) {
#if PRESET_TOKUYOSHI_KAPLANYAN_2019
  return h.xy / max(abs(h.z), 1e-4);
#else
  return h.xy;
#endif
}

// For the unit half vectors of one light at the pixel and the next ones, each in its own frame.
mat2 widenedMatrix(float alpha2, vec3 here, vec3 right, vec3 above) {
  const float gaussian_pixel = 0.5 / pi;  // variance of the pixel's filter
  vec2 at = spreadOf(here);
  vec2 dx = spreadOf(right) - at;
  vec2 dy = spreadOf(above) - at;
  mat2 kernel = 2.0 * gaussian_pixel * (outerProduct(dx, dx) + outerProduct(dy, dy));
#if PRESET_TOKUYOSHI_KAPLANYAN_2019
  return mat2(alpha2) + kernel;
#else
  // (P'^-1 + 1)^-1 of P' = alpha^2 / (1 - alpha^2) + kernel, without a quotient that grows.
  mat2 scaled = max(1.0 - alpha2, 0.0) * kernel;
  return (mat2(alpha2) + scaled) * inverse(mat2(1.0) + scaled);
#endif
}

#if SCREEN_DERIVATIVES
// The matrix where there is no light: for a half vector along the normal, which stays while the frames turn about it.
mat2 matrixAboutNormal(float alpha2, vec3 n, vec3 n_right, vec3 n_above, Footprints f) {
  vec3 right = n + transpose(f.frame_dx) * n;
  vec3 above = n + transpose(f.frame_dy) * n;
  return widenedMatrix(alpha2, vec3(0.0, 0.0, 1.0), inFacetFrame(right, n_right), inFacetFrame(above, n_above));
}
#endif

// Density over solid angle about z: the round lobe of the same determinant, with its slopes stretched. A microfacet
// density times the cosine is one over slopes (dh = cos^3 dslope), Blinn-Phong's and vMF's without it.
float matrixDensity(mat2 alpha2, vec3 h) {
  if (h.z <= 0.0) return 0.0;
  float size = sqrt(max(determinant(alpha2), 1e-24));
  float lobe = lobeFromVariance(0.5 * size);
  float own = 2.0 * lobeVariance(lobe);
  float stretched = own * max(dot(h.xy, inverse(alpha2) * h.xy), 0.0);
  float ratio = inversesqrt(h.z * h.z + stretched);
#if DISTRIBUTION_GGX || DISTRIBUTION_BECKMANN
  float jacobian = ratio * ratio * ratio * ratio;
#else
  float jacobian = ratio * ratio * ratio;
#endif
  vec3 turned = ratio * vec3(sqrt(stretched), 0.0, h.z);
  return lobeDensity(lobe, vec3(0.0, 0.0, 1.0), turned) * (jacobian * own / size);
}
#else
// Presets that widen a round lobe by the normal's changes dx and dy to the next pixels.
float sumSquared(vec3 dx, vec3 dy) { return dot(dx, dx) + dot(dy, dy); }
float longestSquared(vec3 dx, vec3 dy) { return max(dot(dx, dx), dot(dy, dy)); }

// Lobes beyond 1 (Blinn-Phong's and vMF's have no such end) stay as they are.
float saturated(float value, float before) { return min(value, max(before, 1.0)); }

float addedTo(float before, float constant, float cap, vec3 dx, vec3 dy) {
  return saturated(before + min(constant * sumSquared(dx, dy), cap), before);
}

float fourth(float x) { return x * x * x * x; }

#if PRESET_UNREAL || PRESET_BABYLON
// On perceptual roughness.
float curvatureRoughness(float rho, vec3 dx, vec3 dy) {
  return max(rho, min(pow(max(longestSquared(dx, dy), 1e-30), 0.333), 1.0));
}
#endif

// alpha'^2 of alpha^2, which is twice the lobe's slope variance; under punctual lights.
float screenWidened(float alpha2, vec3 dx, vec3 dy) {
#if PRESET_FILAMENT
  return addedTo(alpha2, 0.3, 0.04, dx, dy);
#elif PRESET_UNITY
  return addedTo(alpha2, 0.2, 0.04, dx, dy);
#elif PRESET_O3DE
  return addedTo(alpha2, 0.5, 0.18, dx, dy);
#elif PRESET_GODOT
  float alpha = addedTo(sqrt(alpha2), 0.5, 0.18, dx, dy);  // on rho^2
  return alpha * alpha;
#elif PRESET_BEVY
  return addedTo(alpha2, 0.25, 0.18, dx, dy);
#elif PRESET_UNREAL
  float rho = sqrt(sqrt(alpha2));
  return max(fourth(curvatureRoughness(rho, dx, dy)), alpha2);  // no less by rounding
#elif PRESET_THREE
  float least = max(sqrt(sqrt(alpha2)), 0.0525);
  vec3 largest = max(abs(dx), abs(dy));
  return max(fourth(saturated(least + max(max(largest.x, largest.y), largest.z), least)), alpha2);
#elif PRESET_BABYLON
  float alpha = sqrt(alpha2);
  float rho = curvatureRoughness(sqrt(alpha), dx, dy);
  float wide = saturated(rho * rho + 5e-4, alpha);
  return max(wide * wide, alpha2);
#else
  return addedTo(alpha2, option_constant, option_cap, dx, dy);
#endif
}

#if PRESET_BABYLON
float screenWidenedForEnvironment(float alpha2, vec3 dx, vec3 dy) {
  float alpha = sqrt(alpha2);
  float wide = saturated(alpha + 5e-4 + 0.75 * sqrt(longestSquared(dx, dy)), alpha);
  return max(wide * wide, alpha2);
}
#endif
#endif

// The lobe before: the mean roughness, as it is or with what was baked into it.
float alpha2Before(Footprints f) {
#if BAKE_NONE
  return 2.0 * lobeVariance(baseLobe(f));
#else
  return bakedAlpha2(f);
#endif
}

#if SCREEN_DERIVATIVES
// Shading normals of this pixel and of the next ones, from a texture, because those pixels may not be drawn.
struct ScreenNormals {
  vec3 here;
  vec3 right;  // in the frame of the pixel on the right
  vec3 above;
};

Footprints shifted(Footprints f, vec2 steps) {
  f.normal.uv += steps.x * f.normal.dx + steps.y * f.normal.dy;
#if NORMAL_LAYERS
  f.layer.uv += steps.x * f.layer.dx + steps.y * f.layer.dy;
#endif
  return f;
}

ScreenNormals screenNormals(Footprints f) {
  vec3 n = meanNormal(f).xyz;
#if NORMAL_SHADING || (NORMAL_OWN && (PRESET_O3DE || PRESET_GODOT || PRESET_BEVY || PRESET_BABYLON))
  return ScreenNormals(n, meanNormal(shifted(f, vec2(1.0, 0.0))).xyz, meanNormal(shifted(f, vec2(0.0, 1.0))).xyz);
#else
  return ScreenNormals(n, n, n);  // turned with the frame alone
#endif
}
#endif

#if (PRESET_TOKUYOSHI_KAPLANYAN_2019 || PRESET_TOKUYOSHI_KAPLANYAN_2021) && SCREEN_DERIVATIVES && !MULTI_LOBE
struct Effective {
  Facets facets;          // a round lobe as wide, for a geometry term and for environment light
  float alpha2;           // before
  ScreenNormals normals;
  mat2 matrix;            // alpha'^2 of a half vector along the normal
};

Effective effective(Footprints f) {
  Effective e;
  e.alpha2 = alpha2Before(f);
  e.normals = screenNormals(f);
  e.matrix = matrixAboutNormal(e.alpha2, e.normals.here, e.normals.right, e.normals.above, f);
  float spread = 0.25 * (e.matrix[0][0] + e.matrix[1][1]) - 0.5 * e.alpha2;
  e.facets = spreadFacets(e.normals.here, 0.5 * e.alpha2, max(spread, 0.0));
  return e;
}

float ndf(Effective e, vec3 h) { return matrixDensity(e.matrix, inFacetFrame(h, e.facets.normal)); }

Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo, HalfSteps steps) {
  Reflected r;
  r.specular = vec3(0.0);
  if (halfVectorIsDefined(wi, wo)) {
    vec3 h = halfVector(wi, wo);
    vec3 own = inFacetFrame(h, e.normals.here);
    mat2 alpha2 = widenedMatrix(e.alpha2, own, inFacetFrame(h + steps.dx, e.normals.right),
                                inFacetFrame(h + steps.dy, e.normals.above));
    float lobe = lobeFromVariance(0.25 * (alpha2[0][0] + alpha2[1][1]));
    r.specular = fresnelTerm(s.f0, wi, wo) *
                 (matrixDensity(alpha2, own) * geometryFactor(lobe, e.facets.normal, h, wi, wo));
  }
#if DIFFUSE
  r.diffuse = diffuse(e.facets.normal, s, wi, wo);
#endif
  return r;
}

// Shades by light that has no place: an environment's directions.
Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo) { return facetShade(e.facets, s, wi, wo); }
#else
struct Effective {
  Facets facets;
#if PRESET_BABYLON
  Facets lit;  // by lights; an environment lights `facets`
#endif
};

Facets litFacets(Effective e) {
#if PRESET_BABYLON
  return e.lit;
#else
  return e.facets;
#endif
}

Effective effective(Footprints f) {
  float alpha2 = alpha2Before(f);
  vec3 n = meanNormal(f).xyz;
#if !SCREEN_DERIVATIVES
  Facets before = spreadFacets(n, 0.5 * alpha2, 0.0);
#if PRESET_BABYLON
  return Effective(before, before);
#else
  return Effective(before);
#endif
#elif PRESET_TOKUYOSHI_KAPLANYAN_2019 || PRESET_TOKUYOSHI_KAPLANYAN_2021
  ScreenNormals normals = screenNormals(f);
  mat2 matrix = matrixAboutNormal(alpha2, n, normals.right, normals.above, f);
  float spread = 0.25 * (matrix[0][0] + matrix[1][1]) - 0.5 * alpha2;
  return Effective(spreadFacets(n, 0.5 * alpha2, max(spread, 0.0)));
#else
  ScreenNormals normals = screenNormals(f);
  vec3 dx = normals.right - n + f.frame_dx * normals.right;
  vec3 dy = normals.above - n + f.frame_dy * normals.above;
#if PRESET_THREE
  dx = tangent_to_camera * dx;
  dy = tangent_to_camera * dy;
#endif
  Facets after = spreadFacets(n, 0.5 * alpha2, 0.5 * (screenWidened(alpha2, dx, dy) - alpha2));
#if PRESET_BABYLON
  float wide = 0.5 * (screenWidenedForEnvironment(alpha2, dx, dy) - alpha2);
  return Effective(spreadFacets(n, 0.5 * alpha2, wide), after);
#else
  return Effective(after);
#endif
#endif
}

float ndf(Effective e, vec3 h) { return facetDensity(litFacets(e), h); }

Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo) { return facetShade(litFacets(e), s, wi, wo); }
#if SCREEN_DERIVATIVES
Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo, HalfSteps steps) { return shade(e, s, wi, wo); }
#endif
#endif

#if LOBES_LISTED
#include "facet_normal_lobes.glsl"

vec3 meanNormal(Effective e) { return e.facets.normal; }
#endif
