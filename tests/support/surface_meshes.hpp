// Meshes of surfaces by name, and checks that every surface's mesh must pass.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "scenes/surfaces/registry.hpp"

namespace footprint::testing {

/// The mesh of a surface with seed 1 and the parameters given.
[[nodiscard]] inline Mesh make_mesh(const std::string& name,
                                    const std::map<std::string, std::string>& parameters = {}) {
  const Surface& surface = find_surface(all_surfaces(), name);
  return surface.mesh(surface_settings(surface, parameters));
}

/// Checks for whole triangles of material 0, finite vertices, and unit normals and tangents at right angles.
inline void expect_unit_frames(const Mesh& mesh) {
  ASSERT_FALSE(mesh.indices.empty());
  EXPECT_EQ(mesh.indices.size() % 3, 0U);
  EXPECT_EQ(mesh.material, 0);
  for (const Vertex& vertex : mesh.vertices) {
    ASSERT_NEAR(glm::length(vertex.normal), 1.0F, 1e-5F);
    ASSERT_NEAR(glm::length(glm::vec3(vertex.tangent)), 1.0F, 1e-5F);
    ASSERT_NEAR(glm::dot(glm::vec3(vertex.tangent), vertex.normal), 0.0F, 1e-5F);
    ASSERT_EQ(std::abs(vertex.tangent.w), 1.0F);
    ASSERT_TRUE(std::isfinite(glm::dot(vertex.position, vertex.position) + glm::dot(vertex.uv0, vertex.uv0)));
  }
  for (const std::uint32_t index : mesh.indices) ASSERT_LT(index, mesh.vertices.size());
}

/// Checks that triangles are counter-clockwise seen from the side of their normals.
inline void expect_faces_its_normals(const Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const Vertex& a = mesh.vertices[mesh.indices[i]];
    const Vertex& b = mesh.vertices[mesh.indices[i + 1]];
    const Vertex& c = mesh.vertices[mesh.indices[i + 2]];
    const glm::vec3 face = glm::cross(b.position - a.position, c.position - a.position);
    ASSERT_GT(glm::dot(face, a.normal + b.normal + c.normal), 0.0F) << "triangle " << i / 3;
  }
}

/// Checks that texture coordinates increase along tangents and decrease along bitangents.
inline void expect_map_along_tangents(const Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const Vertex& a = mesh.vertices[mesh.indices[i]];
    const Vertex& b = mesh.vertices[mesh.indices[i + 1]];
    const Vertex& c = mesh.vertices[mesh.indices[i + 2]];
    const glm::mat2 coordinates{b.uv0 - a.uv0, c.uv0 - a.uv0};
    ASSERT_NE(glm::determinant(coordinates), 0.0F);
    const glm::mat2x3 along = glm::mat2x3{b.position - a.position, c.position - a.position} * glm::inverse(coordinates);
    const glm::vec3 tangent = glm::normalize(glm::vec3(a.tangent + b.tangent + c.tangent));
    const glm::vec3 bitangent = glm::cross(glm::normalize(a.normal + b.normal + c.normal), tangent) * a.tangent.w;
    ASSERT_GT(glm::dot(glm::normalize(along[0]), tangent), 0.8F) << "triangle " << i / 3;
    ASSERT_LT(glm::dot(glm::normalize(along[1]), bitangent), -0.8F) << "triangle " << i / 3;
  }
}

}  // namespace footprint::testing
