// True visibility of distant light: a ray through the scene's triangles (renderer/visibility/ray_tree.hpp).
struct TreeNode {
  vec3 lower;
  uint skip;
  vec3 upper;
  uint triangles;  // 8 * first + number
};
struct TreeTriangle {
  vec4 corner, edge_u, edge_v;
};
layout(std430, binding = 0) readonly buffer TreeNodes { TreeNode tree_nodes[]; };
layout(std430, binding = 1) readonly buffer TreeTriangles { TreeTriangle tree_triangles[]; };
uniform int tree_node_count;
uniform float ray_offset;  // metres before the surface

// Moeller and Trumbore 1997.
bool meetsTriangle(uint i, vec3 origin, vec3 direction) {
  vec3 edge_u = tree_triangles[i].edge_u.xyz;
  vec3 edge_v = tree_triangles[i].edge_v.xyz;
  vec3 across = cross(direction, edge_v);
  float determinant = dot(edge_u, across);
  if (determinant == 0.0) return false;
  vec3 from = origin - tree_triangles[i].corner.xyz;
  vec3 other = cross(from, edge_u);
  vec3 uvt = vec3(dot(from, across), dot(direction, other), dot(edge_v, other)) / determinant;
  return uvt.x >= 0.0 && uvt.y >= 0.0 && uvt.x + uvt.y <= 1.0 && uvt.z > 0.0;
}

// Whether anything lies in a direction of the world, seen from before the surface whose side `n` is seen.
bool wayIsBlocked(vec3 point, vec3 n, vec3 direction) {
  vec3 origin = point + ray_offset * n;
  vec3 safe = mix(direction, vec3(1e-20), lessThan(abs(direction), vec3(1e-20)));
  int place = 0;
  while (place < tree_node_count) {
    vec3 a = (tree_nodes[place].lower - origin) / safe;
    vec3 b = (tree_nodes[place].upper - origin) / safe;
    vec3 near = min(a, b);
    vec3 far = max(a, b);
    if (max(max(near.x, near.y), max(near.z, 0.0)) > min(far.x, min(far.y, far.z))) {
      place = int(tree_nodes[place].skip);
    } else {
      uint held = tree_nodes[place].triangles;
      for (uint i = held >> 3u; i < (held >> 3u) + (held & 7u); ++i) {
        if (meetsTriangle(i, origin, direction)) return true;
      }
      ++place;
    }
  }
  return false;
}
