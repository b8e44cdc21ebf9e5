// The geometry term of GGX by alpha squared, for f * cos: of a GGX base BRDF and of every clear coat.

// n.l G2 / (4 n.l n.v) with the height-correlated Smith term (Heitz 2014, equation 99; glTF 2.0, appendix B).
float ggxGeometry(float a2, vec3 n, vec3 wi, vec3 wo) {
  float nl = dot(n, wi);
  if (nl <= 0.0) return 0.0;
  float nv = max(dot(n, wo), 1e-4);
  float masked = nl * sqrt(a2 + (1.0 - a2) * nv * nv) + nv * sqrt(a2 + (1.0 - a2) * nl * nl);
  return 0.5 * nl / max(masked, 1e-12);
}
