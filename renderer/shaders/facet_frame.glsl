// The frame of a facet within the tangent frame, rotated with its normal.

// Rotates an axis by the shortest rotation from z to n. 1 / (1 + n_z) is (1 - n_z) / |n_xy|^2 where the sum cancels;
// for n = -z the rotation is about the bitangent.
vec3 turnedWithNormal(vec3 axis, vec3 n) {
  vec2 side = n.xy;
  float share = 1.0 / (1.0 + max(n.z, 0.0));
  if (n.z < 0.0) {
    float size = length(n.xy);
    side = size > 1e-18 ? n.xy / size : vec2(1.0, 0.0);
    share = 1.0 - n.z;
  }
  return vec3(axis.xy - side * (share * dot(side, axis.xy)) + n.xy * axis.z, n.z * axis.z - dot(n.xy, axis.xy));
}

// A direction in the frame of the facet with normal n (inverse rotation), computed once for all lobes.
vec3 inFacetFrame(vec3 h, vec3 n) { return turnedWithNormal(h, vec3(-n.xy, n.z)); }
