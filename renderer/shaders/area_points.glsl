// A point of a light, even over its area: from the centre, in half edges or radii.
vec2 drawnAreaPoint(bool rectangle, vec2 u) {
  if (rectangle) return 2.0 * u - 1.0;
  float azimuth = 2.0 * pi * u.y;
  return sqrt(u.x) * vec2(cos(azimuth), sin(azimuth));
}
