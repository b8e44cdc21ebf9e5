// Four vertices and two triangles in the xy plane, u along x and v downwards.
#include "renderer/scene/plane.hpp"

#include <array>

namespace footprint {

Mesh make_plane(glm::vec2 size, glm::vec2 uv_tiling) {
  constexpr std::array<glm::vec2, 4> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};  // uv, v downwards
  Mesh mesh;
  mesh.name = "plane";
  for (const glm::vec2& corner : corners) {
    Vertex vertex;
    vertex.position = {(corner.x - 0.5F) * size.x, (0.5F - corner.y) * size.y, 0.0F};
    vertex.uv0 = corner * uv_tiling;
    vertex.uv1 = vertex.uv0;
    // v runs against y, so the bitangent (the direction in which v's green channel counts as up) is +y: w = +1.
    vertex.tangent = {1.0F, 0.0F, 0.0F, 1.0F};
    mesh.vertices.push_back(vertex);
  }
  mesh.indices = {0, 3, 2, 0, 2, 1};
  return mesh;
}

}  // namespace footprint
