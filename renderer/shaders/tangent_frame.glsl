// The tangent frame of a point in world space, right-handed or not as the mesh says; columns tangent, bitangent,
// normal. `normal` is that of the side that is seen.
mat3 tangentFrame(vec3 normal, vec4 tangent) {
  vec3 n = normal / max(length(normal), 1e-20);  // opposite normals of a vertex pair meet at zero: unlit, not NaN
  vec3 t = tangent.xyz - n * dot(n, tangent.xyz);
  t /= max(length(t), 1e-12);
  return mat3(t, cross(n, t) * tangent.w, n);
}
