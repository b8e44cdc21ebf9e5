// Texture coordinates that are cut for a mesh: every texel of the square belongs to one triangle at most.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "renderer/scene/charts.hpp"
#include "renderer/scene/geometry.hpp"
#include "tests/support/texture_coverage.hpp"

namespace footprint {
namespace {

Vertex vertex_at(const glm::vec3& position) {
  Vertex vertex;
  vertex.position = position;
  vertex.normal = glm::vec3{0.0F};
  return vertex;
}

/// A closed torus, which no plane can be laid on without several cuts.
Mesh torus(int around, int across) {
  Mesh mesh;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const float a = 6.2831853F * static_cast<float>(i) / static_cast<float>(around);
      const float b = 6.2831853F * static_cast<float>(j) / static_cast<float>(across);
      const float radius = 1.0F + 0.4F * std::cos(b);
      mesh.vertices.push_back(vertex_at({radius * std::cos(a), 0.4F * std::sin(b), -radius * std::sin(a)}));
    }
  }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(i % around * across + j % across); };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      mesh.indices.insert(mesh.indices.end(), {at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.indices.insert(mesh.indices.end(), {at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  repair_normals(mesh.vertices, mesh.indices);
  return mesh;
}

/// A strip that winds around an axis like a staircase, all of it facing upwards: seen from above it overlaps itself.
Mesh spiral(int steps) {
  Mesh mesh;
  for (int i = 0; i <= steps; ++i) {
    const float a = 0.3F * static_cast<float>(i);
    for (const float radius : {0.5F, 1.0F}) {
      mesh.vertices.push_back(vertex_at({radius * std::cos(a), 0.02F * static_cast<float>(i), -radius * std::sin(a)}));
    }
  }
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(steps); ++i) {
    mesh.indices.insert(mesh.indices.end(), {2 * i, 2 * i + 1, 2 * i + 3, 2 * i, 2 * i + 3, 2 * i + 2});
  }
  repair_normals(mesh.vertices, mesh.indices);
  return mesh;
}

double flat_area(const Mesh& mesh) {
  double sum = 0.0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const glm::dvec2 a{mesh.vertices[mesh.indices[i]].uv0};
    const glm::dvec2 b = glm::dvec2(mesh.vertices[mesh.indices[i + 1]].uv0) - a;
    const glm::dvec2 c = glm::dvec2(mesh.vertices[mesh.indices[i + 2]].uv0) - a;
    sum += 0.5 * std::abs(b.x * c.y - b.y * c.x);
  }
  return sum;
}

void expect_valid(const Mesh& before, const Mesh& after) {
  ASSERT_EQ(after.indices.size(), before.indices.size());
  for (std::size_t i = 0; i < after.indices.size(); ++i) {
    const Vertex &old = before.vertices[before.indices[i]], &now = after.vertices[after.indices[i]];
    ASSERT_EQ(now.position, old.position);
    ASSERT_EQ(now.normal, old.normal);
    ASSERT_TRUE(glm::all(glm::greaterThanEqual(now.uv0, glm::vec2{0.0F})));
    ASSERT_TRUE(glm::all(glm::lessThanEqual(now.uv0, glm::vec2{1.0F})));
    ASSERT_EQ(now.uv1, now.uv0);
    ASSERT_NEAR(glm::length(glm::vec3(now.tangent)), 1.0F, 1e-5F);
    ASSERT_NEAR(glm::dot(glm::vec3(now.tangent), now.normal), 0.0F, 1e-5F);
    ASSERT_EQ(now.tangent.w, 1.0F);  // no chart is mirrored
  }
  EXPECT_LE(std::ranges::max(testing::texture_coverage(after, 700)), 1);
}

TEST(Unwrap, LaysATorusFlatWithoutOverlap) {
  const Mesh before = torus(60, 24);
  Mesh after = before;
  unwrap(after);
  expect_valid(before, after);
  EXPECT_GT(flat_area(after), 0.25);  // of the square
}

TEST(Unwrap, CutsAStripThatOverlapsItselfSeenAlongItsAxis) {
  const Mesh before = spiral(80);  // almost four turns
  Mesh after = before;
  unwrap(after);
  expect_valid(before, after);
}

TEST(Unwrap, KeepsOneScaleWithinTheForeshorteningOfAChart) {
  Mesh mesh = torus(60, 24);
  unwrap(mesh);
  double shortest = 1e9, longest = 0.0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const Vertex &a = mesh.vertices[mesh.indices[i]], &b = mesh.vertices[mesh.indices[i + 1]];
    const double ratio = glm::length(glm::dvec2(b.uv0 - a.uv0)) / glm::length(glm::dvec3(b.position - a.position));
    shortest = std::min(shortest, ratio);
    longest = std::max(longest, ratio);
  }
  EXPECT_LT(longest, 2.01 * shortest);
}

TEST(Unwrap, LeavesAFlatSquareInOnePieceUpright) {
  Mesh mesh;
  for (const glm::vec3& corner : {glm::vec3{0, 0, 0}, glm::vec3{2, 0, 0}, glm::vec3{2, 2, 0}, glm::vec3{0, 2, 0}}) {
    mesh.vertices.push_back(vertex_at(corner));
  }
  mesh.indices = {0, 1, 2, 0, 2, 3};
  repair_normals(mesh.vertices, mesh.indices);
  unwrap(mesh);
  ASSERT_EQ(mesh.vertices.size(), 4U);
  EXPECT_NEAR(mesh.vertices[0].uv0.x, 1.0 / 1024, 2e-2);  // packed to within 1% of the smallest square
  EXPECT_NEAR(mesh.vertices[0].uv0.y, 1.0 - 1.0 / 1024, 2e-2);
  EXPECT_NEAR(mesh.vertices[2].uv0.x - mesh.vertices[0].uv0.x, 1.0, 3e-2);
  EXPECT_GT(mesh.vertices[0].tangent.x, 0.999F);
}

TEST(Unwrap, TakesTrianglesWithoutAreaAndMeshesWithoutTriangles) {
  Mesh empty;
  unwrap(empty);
  EXPECT_TRUE(empty.indices.empty());

  Mesh mesh;
  for (const float x : {0.0F, 1.0F, 2.0F}) mesh.vertices.push_back(vertex_at({x, 0.0F, 0.0F}));
  mesh.vertices.push_back(vertex_at({0.0F, 1.0F, 0.0F}));
  mesh.indices = {0, 1, 2, 0, 0, 0, 0, 1, 3};
  repair_normals(mesh.vertices, mesh.indices);
  unwrap(mesh);
  ASSERT_EQ(mesh.indices.size(), 9U);
  for (const Vertex& vertex : mesh.vertices) {
    EXPECT_TRUE(std::isfinite(vertex.uv0.x + vertex.uv0.y + vertex.tangent.x + vertex.tangent.y + vertex.tangent.z));
  }

  Mesh point;
  point.vertices.push_back(vertex_at(glm::vec3{1.0F}));
  point.indices = {0, 0, 0};
  repair_normals(point.vertices, point.indices);
  unwrap(point);
  EXPECT_TRUE(std::isfinite(point.vertices.front().uv0.x + point.vertices.front().uv0.y));
}

}  // namespace
}  // namespace footprint
