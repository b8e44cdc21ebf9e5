// The geometric normal of a triangle on the side of the viewer, from screen derivatives of the position. Zero if the
// triangle is edge-on. A power of two brings the derivatives near 1, because their fourth powers would underflow in
// scenes of a micrometre, and overflow in those of a million kilometres.
vec3 facetNormal(vec3 along_x, vec3 along_y, vec3 to_viewer) {
  vec3 largest = max(abs(along_x), abs(along_y));
  int exponent;
  frexp(max(largest.x, max(largest.y, largest.z)), exponent);
  vec3 n = cross(ldexp(along_x, ivec3(-exponent)), ldexp(along_y, ivec3(-exponent)));
  float size = length(n);
  return size > 0.0 ? n * (sign(dot(n, to_viewer)) / size) : vec3(0.0);
}
