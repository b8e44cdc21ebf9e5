// The normal distribution function, to 1.4e-4 (Page 1977).
float normalCdf(float x) {
  float z = clamp(x, -8.0, 8.0);
  return 1.0 / (1.0 + exp(-z * (1.5976 + 0.070565992 * z * z)));
}
