// The tangent frame of a point in world space with the handedness of the mesh; columns tangent, bitangent, normal.
// `normal` is on the visible side.
mat3 tangentFrame(vec3 normal, vec4 tangent) {
  vec3 n = normal / max(length(normal), 1e-20);  // opposite normals of a vertex pair meet at zero: unlit, not NaN
  vec3 t = tangent.xyz - n * dot(n, tangent.xyz);
  t /= max(length(t), 1e-12);
  return mat3(t, cross(n, t) * tangent.w, n);
}

// The frame on the side that is seen. A back reverses the whole normal of a normal map (glTF 2.0, section 3.9.4), so all
// three axes turn round: x and y with the tangent and its handedness, z with the normal.
mat3 seenFrame(bool front, vec3 normal, vec4 tangent) {
  float side = front ? 1.0 : -1.0;
  return tangentFrame(side * normal, side * tangent);
}
