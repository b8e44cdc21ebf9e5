// Tokuyoshi and Kaplanyan 2019, 2021: half vectors of a light spread over the pixel, in the frame of the normal, and
// the lobe takes their covariance. Matrices are alpha^2, twice the covariance of slopes.
//? include facet_frame.glsl

// What of a half vector is spread: its slope in 2019, its projection on the disc in 2021.
vec2 spreadOf(vec3 h) {
//? if preset_tokuyoshi_kaplanyan_2019
  return h.xy / max(abs(h.z), 1e-4);
//? else
  return h.xy;
//? end
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
//? if distribution_ggx or distribution_beckmann
  float jacobian = ratio * ratio * ratio * ratio;
//? else
  float jacobian = ratio * ratio * ratio;
//? end
  vec3 turned = ratio * vec3(sqrt(stretched), 0.0, h.z);
  return lobeDensity(lobe, vec3(0.0, 0.0, 1.0), turned) * (jacobian * own / size);
}
