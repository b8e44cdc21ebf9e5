// The octahedral map of the sphere, +y in the middle, on the unit square (Praun and Hoppe 2003).
vec2 octahedral(vec3 d) {
  vec3 p = d / (abs(d.x) + abs(d.y) + abs(d.z));
  if (p.y >= 0.0) return 0.5 + 0.5 * p.xz;
  vec2 folded = 1.0 - abs(p.zx);
  return 0.5 + 0.5 * vec2(p.x >= 0.0 ? folded.x : -folded.x, p.z >= 0.0 ? folded.y : -folded.y);
}

// A border of one texel repeats the texels across the edge, so that linear filtering has no seam.
vec2 borderedUv(vec2 uv, vec2 size) { return (1.0 + uv * (size - 2.0)) / size; }
