// Where a unit vector of the upper hemisphere lies in [0, 1]^2, cells of equal area being cells of equal solid angle
// (Shirley and Chiu 1997); below the horizon: the rim. Twin of renderer/microgeometry/direction_grid.cpp.
vec2 hemisphereToSquare(vec3 w) {
  float sine2 = dot(w.xy, w.xy);
  if (sine2 == 0.0) return vec2(0.5);
  float radius = w.z > 0.0 ? min(sqrt(sine2 / (1.0 + w.z)), 1.0) : 1.0;
  bool wide = abs(w.x) > abs(w.y);
  float lead = (wide ? w.x : w.y) < 0.0 ? -radius : radius;
  float other = lead * atan(wide ? w.y / w.x : w.x / w.y) * (4.0 / pi);
  return 0.5 * (wide ? vec2(lead, other) : vec2(other, lead)) + 0.5;
}
