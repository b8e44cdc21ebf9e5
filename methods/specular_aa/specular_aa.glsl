// Engines' screen-space filters of normals; tests/methods/screen_presets.hpp has the same formulas in double precision.
// Without neighbouring pixels (a sample of a supersampled image, the NDF inspector) the lobe is not widened.
//? include mean_normal.glsl
//? include mean_roughness.glsl
//? include baked_roughness.glsl if not bake_none

//? if preset_tokuyoshi_kaplanyan_2019 or preset_tokuyoshi_kaplanyan_2021
// Tokuyoshi and Kaplanyan 2019, 2021: half vectors of a light spread over the pixel, in the frame of the normal, and
// the lobe takes their covariance. Matrices are alpha^2, twice the covariance of slopes.
//? include facet_frame.glsl

// What of a half vector is spread: its slope in 2019, its projection on the disc in 2021.
vec2 spreadOf(vec3 h) {
  return h.xy / max(abs(h.z), 1e-4);  //? if preset_tokuyoshi_kaplanyan_2019
  return h.xy;                        //? else
}

// For the unit half vectors of one light at the pixel and the next ones, each in its own frame.
mat2 widenedMatrix(float alpha2, vec3 here, vec3 right, vec3 above) {
  const float gaussian_pixel = 0.5 / pi;  // variance of the pixel's filter
  vec2 at = spreadOf(here);
  vec2 dx = spreadOf(right) - at;
  vec2 dy = spreadOf(above) - at;
  mat2 kernel = 2.0 * gaussian_pixel * (outerProduct(dx, dx) + outerProduct(dy, dy));
//? if preset_tokuyoshi_kaplanyan_2019
  return mat2(alpha2) + kernel;
//? else
  // (P'^-1 + 1)^-1 of P' = alpha^2 / (1 - alpha^2) + kernel, without a quotient that grows.
  mat2 scaled = max(1.0 - alpha2, 0.0) * kernel;
  return (mat2(alpha2) + scaled) * inverse(mat2(1.0) + scaled);
//? end
}

//? if screen_derivatives
// Where there is no light: for a half vector along the normal, which stays while the frames turn about it.
mat2 matrixAboutNormal(float alpha2, vec3 n, vec3 n_right, vec3 n_above, Footprints f) {
  vec3 right = n + transpose(f.frame_dx) * n;
  vec3 above = n + transpose(f.frame_dy) * n;
  return widenedMatrix(alpha2, vec3(0.0, 0.0, 1.0), inFacetFrame(right, n_right), inFacetFrame(above, n_above));
}
//? end

// Density over solid angle about z: the round lobe of the same determinant, with its slopes stretched. A microfacet
// density times the cosine is one over slopes (dh = cos^3 dslope), Blinn-Phong's and vMF's without it.
float matrixDensity(mat2 alpha2, vec3 h) {
  if (h.z <= 0.0) return 0.0;
  float size = sqrt(max(determinant(alpha2), 1e-24));
  float lobe = lobeFromVariance(0.5 * size);
  float own = 2.0 * lobeVariance(lobe);
  float stretched = own * max(dot(h.xy, inverse(alpha2) * h.xy), 0.0);
  float ratio = inversesqrt(h.z * h.z + stretched);
  float jacobian = ratio * ratio * ratio * ratio;  //? if distribution_ggx or distribution_beckmann
  float jacobian = ratio * ratio * ratio;          //? else
  vec3 turned = ratio * vec3(sqrt(stretched), 0.0, h.z);
  return lobeDensity(lobe, vec3(0.0, 0.0, 1.0), turned) * (jacobian * own / size);
}
//? else
// Presets that widen a round lobe by the normal's changes dx and dy to the next pixels.
float sumSquared(vec3 dx, vec3 dy) { return dot(dx, dx) + dot(dy, dy); }
float longestSquared(vec3 dx, vec3 dy) { return max(dot(dx, dx), dot(dy, dy)); }

// Lobes beyond 1 (Blinn-Phong's and vMF's have no such end) stay as they are.
float saturated(float value, float before) { return min(value, max(before, 1.0)); }

float addedTo(float before, float constant, float cap, vec3 dx, vec3 dy) {
  return saturated(before + min(constant * sumSquared(dx, dy), cap), before);
}

float fourth(float x) { return x * x * x * x; }

//? if preset_unreal or preset_babylon
// On perceptual roughness.
float curvatureRoughness(float rho, vec3 dx, vec3 dy) {
  return max(rho, min(pow(max(longestSquared(dx, dy), 1e-30), 0.333), 1.0));
}
//? end

// alpha'^2 of alpha^2, which is twice the lobe's slope variance; under punctual lights.
float screenWidened(float alpha2, vec3 dx, vec3 dy) {
//? if preset_filament
  return addedTo(alpha2, 0.3, 0.04, dx, dy);
//? elif preset_unity
  return addedTo(alpha2, 0.2, 0.04, dx, dy);
//? elif preset_o3de
  return addedTo(alpha2, 0.5, 0.18, dx, dy);
//? elif preset_godot
  float alpha = addedTo(sqrt(alpha2), 0.5, 0.18, dx, dy);  // on rho^2
  return alpha * alpha;
//? elif preset_bevy
  return addedTo(alpha2, 0.25, 0.18, dx, dy);
//? elif preset_unreal
  float rho = sqrt(sqrt(alpha2));
  return max(fourth(curvatureRoughness(rho, dx, dy)), alpha2);  // no less by rounding
//? elif preset_three
  float least = max(sqrt(sqrt(alpha2)), 0.0525);
  vec3 largest = max(abs(dx), abs(dy));
  return max(fourth(saturated(least + max(max(largest.x, largest.y), largest.z), least)), alpha2);
//? elif preset_babylon
  float alpha = sqrt(alpha2);
  float rho = curvatureRoughness(sqrt(alpha), dx, dy);
  float wide = saturated(rho * rho + 5e-4, alpha);
  return max(wide * wide, alpha2);
//? else
  return addedTo(alpha2, option_constant, option_cap, dx, dy);
//? end
}

//? if preset_babylon
float screenWidenedForEnvironment(float alpha2, vec3 dx, vec3 dy) {
  float alpha = sqrt(alpha2);
  float wide = saturated(alpha + 5e-4 + 0.75 * sqrt(longestSquared(dx, dy)), alpha);
  return max(wide * wide, alpha2);
}
//? end
//? end

// The lobe before: the mean roughness, as it is or with what was baked into it.
float alpha2Before(Footprints f) {
  return 2.0 * lobeVariance(baseLobe(f));  //? if bake_none
  return bakedAlpha2(f);                   //? else
}

//? if screen_derivatives
// Shading normals of this pixel and of the next ones, from a texture, because those pixels may not be drawn.
struct ScreenNormals {
  vec3 here;
  vec3 right;  // in the frame of the pixel on the right
  vec3 above;
};

Footprints shifted(Footprints f, vec2 steps) {
  f.normal.uv += steps.x * f.normal.dx + steps.y * f.normal.dy;
  f.layer.uv += steps.x * f.layer.dx + steps.y * f.layer.dy;  //? if normal_layers
  return f;
}

ScreenNormals screenNormals(Footprints f) {
  vec3 n = meanNormal(f).xyz;
//? if normal_shading or (normal_own and (preset_o3de or preset_godot or preset_bevy or preset_babylon))
  return ScreenNormals(n, meanNormal(shifted(f, vec2(1.0, 0.0))).xyz, meanNormal(shifted(f, vec2(0.0, 1.0))).xyz);
//? else
  return ScreenNormals(n, n, n);  // turned with the frame alone
//? end
}
//? end

//? if (preset_tokuyoshi_kaplanyan_2019 or preset_tokuyoshi_kaplanyan_2021) and screen_derivatives and not multi_lobe
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
  r.diffuse = diffuse(e.facets.normal, s, wi, wo);  //? if diffuse
  return r;
}

// Of light that has no place: an environment's directions.
Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo) { return facetShade(e.facets, s, wi, wo); }
//? else
struct Effective {
  Facets facets;
  Facets lit;  // by lights; an environment lights `facets`  //? if preset_babylon
};

Facets litFacets(Effective e) {
  return e.lit;     //? if preset_babylon
  return e.facets;  //? else
}

Effective effective(Footprints f) {
  float alpha2 = alpha2Before(f);
  vec3 n = meanNormal(f).xyz;
//? if not screen_derivatives
  Facets before = spreadFacets(n, 0.5 * alpha2, 0.0);
  return Effective(before, before);  //? if preset_babylon
  return Effective(before);          //? else
//? elif preset_tokuyoshi_kaplanyan_2019 or preset_tokuyoshi_kaplanyan_2021
  ScreenNormals normals = screenNormals(f);
  mat2 matrix = matrixAboutNormal(alpha2, n, normals.right, normals.above, f);
  float spread = 0.25 * (matrix[0][0] + matrix[1][1]) - 0.5 * alpha2;
  return Effective(spreadFacets(n, 0.5 * alpha2, max(spread, 0.0)));
//? else
  ScreenNormals normals = screenNormals(f);
  vec3 dx = normals.right - n + f.frame_dx * normals.right;
  vec3 dy = normals.above - n + f.frame_dy * normals.above;
//? if preset_three
  dx = tangent_to_camera * dx;
  dy = tangent_to_camera * dy;
//? end
  Facets after = spreadFacets(n, 0.5 * alpha2, 0.5 * (screenWidened(alpha2, dx, dy) - alpha2));
//? if preset_babylon
  float wide = 0.5 * (screenWidenedForEnvironment(alpha2, dx, dy) - alpha2);
  return Effective(spreadFacets(n, 0.5 * alpha2, wide), after);
//? else
  return Effective(after);
//? end
//? end
}

float ndf(Effective e, vec3 h) { return facetDensity(litFacets(e), h); }

Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo) { return facetShade(litFacets(e), s, wi, wo); }
//? if screen_derivatives
Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo, HalfSteps steps) { return shade(e, s, wi, wo); }
//? end
//? end

//? if lobes_listed
//? include facet_normal_lobes.glsl

vec3 meanNormal(Effective e) { return e.facets.normal; }
//? end
