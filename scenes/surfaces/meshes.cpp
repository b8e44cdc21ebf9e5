// Grids of vertices over the unit square, and vertices whose tangent and normal are derivatives of their position.
#include "scenes/surfaces/meshes.hpp"

#include "renderer/scene/plane.hpp"

namespace footprint {

Vertex bent_vertex(const BentPoint& point, const glm::dvec2& uv) {
  const auto along = [&](int axis) {
    return glm::dvec3{point.x.derivatives()[axis], point.y.derivatives()[axis], point.z.derivatives()[axis]};
  };
  Vertex vertex;
  vertex.position = glm::dvec3{point.x.value(), point.y.value(), point.z.value()};
  vertex.tangent = {glm::vec3{glm::normalize(along(0))}, 1.0F};
  vertex.normal = glm::normalize(glm::cross(along(0), along(1)));
  vertex.uv0 = vertex.uv1 = glm::vec2{uv};
  return vertex;
}

Mesh square_mesh(const SurfaceSettings& /*settings*/) { return make_plane({2.0F, 2.0F}, {1.0F, 1.0F}); }

Mesh grid_mesh(int columns, int rows, const std::function<Vertex(const glm::dvec2& st)>& vertex_at) {
  Mesh mesh;
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      mesh.vertices.push_back(vertex_at({static_cast<double>(column) / columns, static_cast<double>(row) / rows}));
    }
  }
  const auto at = [&](int column, int row) { return static_cast<std::uint32_t>(row * (columns + 1) + column); };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const std::uint32_t low_left = at(column, row), low_right = at(column + 1, row);
      const std::uint32_t high_left = at(column, row + 1), high_right = at(column + 1, row + 1);
      mesh.indices.insert(mesh.indices.end(), {low_left, low_right, high_right, low_left, high_right, high_left});
    }
  }
  return mesh;
}

}  // namespace footprint
