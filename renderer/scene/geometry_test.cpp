// Normals and triangle lists against values worked out by hand.
#include "renderer/scene/geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/support/expect_near.hpp"

namespace footprint {
namespace {

using test::expect_near;

TEST(Geometry, StripsAndFansKeepTheWindingOfGltf) {
  const std::vector<std::uint32_t> indices{10, 11, 12, 13, 14};
  EXPECT_EQ(triangle_list(indices, Topology::strip), (std::vector<std::uint32_t>{10, 11, 12, 11, 13, 12, 12, 13, 14}));
  EXPECT_EQ(triangle_list(indices, Topology::fan), (std::vector<std::uint32_t>{11, 12, 10, 12, 13, 10, 13, 14, 10}));
  EXPECT_EQ(triangle_list(indices, Topology::triangles), (std::vector<std::uint32_t>{10, 11, 12}));
  EXPECT_TRUE(triangle_list(std::vector<std::uint32_t>{1, 2}, Topology::fan).empty());
}

TEST(Geometry, UnusedVerticesGo) {
  std::vector<Vertex> vertices(5);
  for (std::size_t i = 0; i < vertices.size(); ++i) vertices[i].position.x = static_cast<float>(i);
  std::vector<std::uint32_t> indices{4, 1, 3};
  drop_unused_vertices(vertices, indices);
  ASSERT_EQ(vertices.size(), 3U);
  EXPECT_EQ(indices, (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(vertices[0].position.x, 4.0F);
  EXPECT_EQ(vertices[2].position.x, 3.0F);
}

TEST(Geometry, PlaneMatchesItsDescription) {
  const Mesh plane = make_plane({4.0F, 2.0F}, {3.0F, 5.0F});
  ASSERT_EQ(plane.vertices.size(), 4U);
  ASSERT_EQ(plane.indices.size(), 6U);
  expect_near(plane.vertices[0].position, {-2.0F, 1.0F, 0.0F});
  expect_near(plane.vertices[2].position, {2.0F, -1.0F, 0.0F});
  EXPECT_EQ(plane.vertices[0].uv0, glm::vec2(0.0F));
  EXPECT_EQ(plane.vertices[2].uv0, glm::vec2(3.0F, 5.0F));
  for (std::size_t i = 0; i < 6; i += 3) {
    const auto corner = [&](std::size_t k) { return plane.vertices[plane.indices[i + k]].position; };
    EXPECT_GT(glm::cross(corner(1) - corner(0), corner(2) - corner(0)).z, 0.0F) << "counter-clockwise from +z";
  }
}

TEST(Geometry, FlatNormalsBelongToTriangles) {
  std::vector<Vertex> vertices(4);
  vertices[1].position = {1, 0, 0};
  vertices[2].position = {0, 1, 0};
  vertices[3].position = {0, 0, 1};
  std::vector<std::uint32_t> indices{0, 1, 2, 0, 3, 1, 0, 0, 1};
  make_flat_normals(vertices, indices);
  ASSERT_EQ(vertices.size(), 9U);
  expect_near(vertices[0].normal, {0, 0, 1});
  expect_near(vertices[4].normal, {0, 1, 0});
  expect_near(vertices[8].normal, {0, 0, 1});  // degenerate
}

TEST(Geometry, NormalsWithoutDirectionAreReplacedAndCounted) {
  Mesh plane = make_plane({2.0F, 2.0F}, {1.0F, 1.0F});
  plane.vertices[0].normal = glm::vec3{0.0F};
  plane.vertices[1].normal = glm::vec3{std::numeric_limits<float>::quiet_NaN(), 0.0F, 1.0F};
  plane.vertices[2].normal = {0.0F, 3.0F, 4.0F};
  plane.vertices[3].normal = {0.0F, 0.0F, 1e-30F};
  EXPECT_EQ(repair_normals(plane.vertices, plane.indices), 2U);
  expect_near(plane.vertices[0].normal, {0, 0, 1});
  expect_near(plane.vertices[1].normal, {0, 0, 1});
  expect_near(plane.vertices[2].normal, {0.0F, 0.6F, 0.8F});
  expect_near(plane.vertices[3].normal, {0, 0, 1});
}

}  // namespace
}  // namespace footprint
