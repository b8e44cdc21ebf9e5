// The geometric normal of a triangle on the side of the viewer, from screen derivatives of the position. Zero if the
// triangle is edge-on.
vec3 facetNormal(vec3 along_x, vec3 along_y, vec3 to_viewer) {
  vec3 n = cross(along_x, along_y);
  float size = length(n);
  return size > 0.0 ? n * (sign(dot(n, to_viewer)) / size) : vec3(0.0);
}
