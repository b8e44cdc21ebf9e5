// Shorter edges, the same surface.
#include "renderer/scene/geometry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "tests/support/mesh_area.hpp"
#include "tests/support/shadow_scenes.hpp"

namespace footprint::testing {
namespace {

float longest_edge(const Mesh& mesh) {
  float longest = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
    longest = std::max(
        longest, glm::distance(mesh.vertices[mesh.indices[i]].position, mesh.vertices[mesh.indices[next]].position));
  }
  return longest;
}

TEST(Subdivided, EdgesAreShortAndTheSurfaceIsTheSame) {
  for (const Mesh& mesh : {white_floor().meshes[0], box_mesh({0, 0, 0}, {1, 2, 0.3F}), sphere_mesh({0, 0, 0}, 1, 5)}) {
    const Mesh fine = subdivided(mesh, 0.11F);
    EXPECT_LE(longest_edge(fine), 0.11F);
    EXPECT_NEAR(mesh_area(fine), mesh_area(mesh), 1e-5 * mesh_area(mesh));
    EXPECT_LT(fine.indices.size() / 3, 40.0 * mesh_area(mesh) / (0.11 * 0.11));
    ASSERT_GE(fine.vertices.size(), mesh.vertices.size());
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
      EXPECT_EQ(fine.vertices[i].position, mesh.vertices[i].position);
  }
}

// Every edge that two triangles shared is shared by two again: no gaps, no vertex in the middle of an edge.
TEST(Subdivided, TrianglesStillMeet) {
  const Mesh fine = subdivided(sphere_mesh({0.1F, 0.2F, 0.3F}, 1.0F, 4), 0.2F);
  const auto key = [](const glm::vec3& p) { return std::array{p.x, p.y, p.z}; };
  std::map<std::pair<std::array<float, 3>, std::array<float, 3>>, int> uses;
  for (std::size_t i = 0; i < fine.indices.size(); ++i) {
    const glm::vec3& a = fine.vertices[fine.indices[i]].position;
    const glm::vec3& b = fine.vertices[fine.indices[i % 3 == 2 ? i - 2 : i + 1]].position;
    if (a != b) uses[std::minmax(key(a), key(b))] += 1;
  }
  // Rings end in triangles without area at the poles, whose long edges lie on their neighbours'.
  const auto odd = std::ranges::count_if(uses, [](const auto& use) { return use.second % 2 != 0; });
  EXPECT_EQ(odd, 0);
}

TEST(Subdivided, MiddlesInterpolate) {
  Mesh mesh = white_floor().meshes[0];
  mesh.vertices[0].normal = {0.6F, 0.0F, 0.8F};
  for (Vertex& vertex : mesh.vertices) vertex.color = {vertex.uv0, 0.25F, vertex.uv0.x};
  const Mesh fine = subdivided(mesh, 1.9F);
  for (const Vertex& vertex : fine.vertices) {
    EXPECT_NEAR(vertex.uv0.x, 0.5F + 0.5F * vertex.position.x, 1e-6F);
    EXPECT_NEAR(vertex.uv0.y, 0.5F - 0.5F * vertex.position.y, 1e-6F);
    EXPECT_EQ(vertex.color, glm::vec4(vertex.uv0, 0.25F, vertex.uv0.x));
  }
}

TEST(Subdivided, PosesAreSplitAlike) {
  const Mesh rest = sphere_mesh({0, 0, 0}, 1.0F, 5);
  Mesh pose = rest;
  for (Vertex& vertex : pose.vertices) vertex.position *= glm::vec3(0.2F, 3.0F, 1.0F);
  const Mesh fine = subdivided(rest, 0.2F), alike = subdivided(pose, 0.2F, &rest);
  EXPECT_EQ(alike.indices, fine.indices);
  ASSERT_EQ(alike.vertices.size(), fine.vertices.size());
  for (std::size_t i = 0; i < fine.vertices.size(); ++i)
    EXPECT_LT(glm::distance(alike.vertices[i].position, fine.vertices[i].position * glm::vec3(0.2F, 3.0F, 1.0F)),
              1e-6F);
  EXPECT_NE(subdivided(pose, 0.2F).indices, fine.indices);
}

TEST(Subdivided, NothingToDo) {
  const Mesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(subdivided(mesh, std::numeric_limits<float>::infinity()).indices, mesh.indices);
  EXPECT_EQ(subdivided(Mesh{}, 0.1F).indices.size(), 0U);
  EXPECT_THROW((void)subdivided(mesh, 0.0F), std::logic_error);
}

}  // namespace
}  // namespace footprint::testing
