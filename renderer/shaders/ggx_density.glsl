// The density of GGX by alpha squared, over solid angle: of a GGX base BRDF and of every clear coat.

// alpha^2 / (pi (alpha^2 cos^2 + sin^2)^2) (Trowbridge and Reitz 1975; Walter 2007, equation 33).
float ggxDensity(float a2, vec3 n, vec3 h) {
  float c = dot(n, h);
  if (c <= 0.0) return 0.0;
  vec3 s = cross(n, h);  // |s| = sin, exact where 1 - c^2 cancels
  float d = a2 * c * c + dot(s, s);
  return a2 / (pi * d * d);
}
