// A detail layer over a normal map: the slopes b = -n_xy / n_z of two bump layers add (Olano and Baker 2010, section
// 4).

// The unit normal of the sum of the slopes of two normals. n_z below 0.02 counts as 0.02, as in the moments of slope.
vec3 withSlopesAdded(vec3 a, vec3 b) {
  float az = max(a.z, 0.02 * length(a));
  float bz = max(b.z, 0.02 * length(b));
  return normalize(vec3(a.xy * bz + b.xy * az, az * bz));
}
