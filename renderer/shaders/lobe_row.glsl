// A row of round lobes for a stretched one, along its longer axis and as wide as it is across: Gaussian weights at even
// steps up to 2.1 standard deviations, with the same variance.
const int half_row = 4;
const int row_count = 2 * half_row + 1;

// widths: squared alphas in the frame of the facets with the normal `n`. k: below row_count.
NormalLobe lobeOfWidths(mat2 widths, vec3 n, int k, float share) {
  vec2 deviator = vec2(0.5 * (widths[0][0] - widths[1][1]), widths[0][1]);
  float radius = length(deviator);
  float across = max(0.5 * (widths[0][0] + widths[1][1]) - radius, smallest_alpha * smallest_alpha);
  vec2 along = deviator.x >= 0.0 ? vec2(radius + deviator.x, deviator.y) : vec2(deviator.y, radius - deviator.x);
  float x = float(k - half_row);
  vec2 slope = along * (0.5578 * x * sqrt(radius) / max(length(along), 1e-12));
  float deviations = 2.1 / float(half_row) * x;
  vec3 axis = turnedWithNormal(normalize(vec3(slope, 1.0)), n);
  NormalLobe lobe = baseNormalLobe(axis, lobeFromAlpha(sqrt(across)), share * exp(-0.5 * deviations * deviations) / 4.6941);
  lobe.normal = n;
  return lobe;
}
