// GGX by alpha squared, for the base BRDF and for clear coats: its density over solid angle, and its geometry term for
// f * cos.

// alpha^2 / (pi (alpha^2 cos^2 + sin^2)^2) (Trowbridge and Reitz 1975; Walter 2007, equation 33).
float ggxDensity(float a2, vec3 n, vec3 h) {
  float c = dot(n, h);
  if (c <= 0.0) return 0.0;
  vec3 s = cross(n, h);  // |s| = sin, exact where 1 - c^2 cancels
  float d = a2 * c * c + dot(s, s);
  return a2 / (pi * d * d);
}

// n.l G2 / (4 n.l n.v) with the height-correlated Smith term (Heitz 2014, equation 99; glTF 2.0, appendix B).
float ggxGeometry(float a2, vec3 n, vec3 wi, vec3 wo) {
  float nl = dot(n, wi);
  if (nl <= 0.0) return 0.0;
  float nv = max(dot(n, wo), 1e-4);
  float masked = nl * sqrt(a2 + (1.0 - a2) * nv * nv) + nv * sqrt(a2 + (1.0 - a2) * nl * nl);
  return 0.5 * nl / max(masked, 1e-12);
}
