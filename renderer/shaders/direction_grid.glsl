// Maps a unit vector of the upper hemisphere to [0, 1]^2 with equal areas for equal solid angles (Shirley and Chiu
// 1997). Vectors below the horizon map to the border. Matches renderer/microgeometry/direction_grid.cpp.
vec2 hemisphereToSquare(vec3 w) {
  float sine2 = dot(w.xy, w.xy);
  if (sine2 == 0.0) return vec2(0.5);
  float radius = w.z > 0.0 ? min(sqrt(sine2 / (1.0 + w.z)), 1.0) : 1.0;
  bool wide = abs(w.x) > abs(w.y);
  float lead = (wide ? w.x : w.y) < 0.0 ? -radius : radius;
  float other = lead * atan(wide ? w.y / w.x : w.x / w.y) * (4.0 / pi);
  return 0.5 * (wide ? vec2(lead, other) : vec2(other, lead)) + 0.5;
}

// The inverse: the unit vector at a point of [0, 1]^2.
vec3 squareToHemisphere(vec2 point) {
  vec2 p = 2.0 * point - 1.0;
  if (p == vec2(0.0)) return vec3(0.0, 0.0, 1.0);
  bool wide = abs(p.x) > abs(p.y);
  float radius = wide ? p.x : p.y;  // signed: the angle is that of the sector's axis, or half a turn from it
  float angle = wide ? 0.25 * pi * (p.y / p.x) : 0.5 * pi - 0.25 * pi * (p.x / p.y);
  float sine = radius * sqrt(max(2.0 - radius * radius, 0.0));  // 1 - z^2 for z = 1 - radius^2
  return vec3(sine * cos(angle), sine * sin(angle), 1.0 - radius * radius);
}
