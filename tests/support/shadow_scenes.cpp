// Boxes and spheres of plain triangles, and the bounds of the scenes that they stand in.
#include "tests/support/shadow_scenes.hpp"

#include <cmath>
#include <numbers>

#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

Vertex vertex_of(const glm::vec3& position, const glm::vec3& normal) {
  const glm::vec3 across = std::abs(normal.z) < 0.9F ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0);
  return {.position = position,
          .normal = normal,
          .tangent = glm::vec4(glm::normalize(glm::cross(across, normal)), 1.0F),
          .uv0 = {},
          .uv1 = {}};
}

void append_cell(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
}

}  // namespace

Mesh box_mesh(const glm::vec3& lower, const glm::vec3& upper, int material) {
  Mesh mesh{.name = "box", .vertices = {}, .indices = {}, .material = material};
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      glm::vec3 normal(0.0F);
      normal[axis] = side == 0 ? -1.0F : 1.0F;
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      for (int corner = 0; corner < 4; ++corner) {
        const bool u = corner == 1 || corner == 2;
        const bool v = corner >= 2;
        glm::vec3 position(0.0F);
        position[axis] = side == 0 ? lower[axis] : upper[axis];
        const int along_u = (axis + (side == 0 ? 2 : 1)) % 3;
        const int along_v = (axis + (side == 0 ? 1 : 2)) % 3;
        position[along_u] = u ? upper[along_u] : lower[along_u];
        position[along_v] = v ? upper[along_v] : lower[along_v];
        mesh.vertices.push_back(vertex_of(position, normal));
      }
      append_cell(mesh, first, first + 1, first + 2, first + 3);
    }
  }
  return mesh;
}

Mesh sphere_mesh(const glm::vec3& centre, float radius, int rings, int material) {
  Mesh mesh{.name = "sphere", .vertices = {}, .indices = {}, .material = material};
  const int sectors = 2 * rings;
  for (int ring = 0; ring <= rings; ++ring) {
    const double polar = std::numbers::pi * ring / rings;
    for (int sector = 0; sector <= sectors; ++sector) {
      const double azimuth = 2.0 * std::numbers::pi * (sector % sectors) / sectors;
      const glm::vec3 normal(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar));
      mesh.vertices.push_back(vertex_of(centre + radius * normal, normal));
    }
  }
  const auto row = static_cast<std::uint32_t>(sectors + 1);
  for (std::uint32_t ring = 0; ring < static_cast<std::uint32_t>(rings); ++ring) {
    for (std::uint32_t sector = 0; sector + 1 < row; ++sector) {
      const std::uint32_t top = ring * row + sector;
      append_cell(mesh, top, top + row, top + row + 1, top + 1);
    }
  }
  return mesh;
}

Scene white_floor() {
  Scene scene = square_scene({}, {.brdf = {NormalDistribution::ggx, GeometryTerm::smith, FresnelTerm::none, true},
                                  .roughness = 1.0F,
                                  .base_color = glm::vec3(1.0F),
                                  .specular = glm::vec3(0.0F),
                                  .metallic = 0.0F});
  scene.lights.clear();
  return scene;
}

Scene box_over_floor() {
  Scene scene = white_floor();
  scene.meshes.push_back(box_mesh({-0.25F, -0.25F, 0.25F}, {0.25F, 0.25F, 0.5F}));
  fit_bounds(scene);
  return scene;
}

void fit_bounds(Scene& scene) {
  scene.bounds.lower = scene.bounds.upper = scene.meshes.front().vertices.front().position;
  for (const Mesh& mesh : scene.meshes) {
    for (const Vertex& vertex : mesh.vertices) {
      scene.bounds.lower = glm::min(scene.bounds.lower, vertex.position);
      scene.bounds.upper = glm::max(scene.bounds.upper, vertex.position);
    }
  }
}

}  // namespace footprint::testing
