// A triangle's own normal on the side of the viewer, from how the position changes over the screen. Zero where the
// pixel sees the triangle edge-on.
vec3 facetNormal(vec3 along_x, vec3 along_y, vec3 to_viewer) {
  vec3 n = cross(along_x, along_y);
  float size = length(n);
  return size > 0.0 ? n * (sign(dot(n, to_viewer)) / size) : vec3(0.0);
}
