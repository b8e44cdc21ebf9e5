// The tangent frame of a point in world space with the handedness of the mesh; columns tangent, bitangent, normal.
// `normal` is on the visible side.
mat3 tangentFrame(vec3 normal, vec4 tangent) {
  vec3 n = normal / max(length(normal), 1e-20);  // opposite normals of a vertex pair meet at zero: unlit, not NaN
  vec3 t = tangent.xyz - n * dot(n, tangent.xyz);
  t /= max(length(t), 1e-12);
  return mat3(t, cross(n, t) * tangent.w, n);
}
