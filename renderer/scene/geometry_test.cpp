// Normals, tangents and triangle lists against frames worked out by hand.
#include "renderer/scene/geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/support/expect_near.hpp"

namespace footprint {
namespace {

using test::expect_near;

glm::vec3 bitangent(const Vertex& vertex) {
  return glm::cross(vertex.normal, glm::vec3{vertex.tangent}) * vertex.tangent.w;
}

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

TEST(Geometry, ComputedTangentsOfThePlaneAreItsOwn) {
  Mesh plane = make_plane({2.0F, 3.0F}, {1.0F, 1.0F});
  for (Vertex& vertex : plane.vertices) vertex.tangent = glm::vec4{0.0F};
  compute_tangents(plane.vertices, plane.indices, {});
  EXPECT_EQ(plane.vertices.size(), 4U);
  for (const Vertex& vertex : plane.vertices) {
    expect_near(glm::vec3{vertex.tangent}, {1.0F, 0.0F, 0.0F});
    expect_near(bitangent(vertex), {0.0F, 1.0F, 0.0F});  // green is up in the image, v is down
  }
}

TEST(Geometry, MirroredCoordinatesTurnTheHandedness) {
  Mesh plane = make_plane({2.0F, 2.0F}, {1.0F, 1.0F});
  for (Vertex& vertex : plane.vertices) vertex.uv0.x = 1.0F - vertex.uv0.x;
  compute_tangents(plane.vertices, plane.indices, {});
  for (const Vertex& vertex : plane.vertices) {
    expect_near(glm::vec3{vertex.tangent}, {-1.0F, 0.0F, 0.0F});
    EXPECT_EQ(vertex.tangent.w, -1.0F);
    expect_near(bitangent(vertex), {0.0F, 1.0F, 0.0F});
  }
}

TEST(Geometry, RotatedTransformTurnsTheFrame) {
  Mesh plane = make_plane({2.0F, 2.0F}, {1.0F, 1.0F});
  TextureCoordinates turned;  // u' = v, v' = -u: u' grows downwards, v' grows to the left
  turned.transform = glm::mat3x2{0.0F, -1.0F, 1.0F, 0.0F, 0.0F, 0.0F};
  compute_tangents(plane.vertices, plane.indices, turned);
  for (const Vertex& vertex : plane.vertices) {
    expect_near(glm::vec3{vertex.tangent}, {0.0F, -1.0F, 0.0F});
    expect_near(bitangent(vertex), {1.0F, 0.0F, 0.0F});  // against v'
  }
}

TEST(Geometry, SharedVerticesOfOppositeHandednessAreSplit) {
  // Two triangles over one edge; u = |x|, so the map is mirrored at x = 0.
  std::vector<Vertex> vertices(4);
  const std::vector<glm::vec3> positions{{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {1, 0, 0}};
  for (std::size_t i = 0; i < 4; ++i) {
    vertices[i].position = positions[i];
    vertices[i].uv0 = {std::abs(positions[i].x), 1.0F - positions[i].y};
  }
  std::vector<std::uint32_t> indices{0, 1, 2, 0, 3, 1};
  compute_tangents(vertices, indices, {});
  EXPECT_EQ(vertices.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    const Vertex& vertex = vertices[indices[i]];
    expect_near(glm::vec3{vertex.tangent}, {i < 3 ? -1.0F : 1.0F, 0.0F, 0.0F});
    EXPECT_EQ(vertex.tangent.w, i < 3 ? -1.0F : 1.0F);
  }
}

TEST(Geometry, SharedVerticesAverageTheirTrianglesByAngle) {
  // At the shared vertex a 90 degree triangle says +x and a 45 degree one says the direction (1, 1) / sqrt 2.
  std::vector<Vertex> vertices(5);
  const std::vector<glm::vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
  const float r = std::numbers::sqrt2_v<float> / 2.0F;
  for (std::size_t i = 0; i < 5; ++i) {
    vertices[i].position = positions[i];
    vertices[i].uv0 = i < 3 ? glm::vec2{positions[i].x, -positions[i].y}
                            : glm::vec2{r * (positions[i].x + positions[i].y), -r * (positions[i].y - positions[i].x)};
  }
  std::vector<std::uint32_t> indices{0, 1, 2, 0, 3, 4};
  compute_tangents(vertices, indices, {});
  EXPECT_EQ(vertices.size(), 5U);
  const glm::vec3 expected = glm::normalize(2.0F * glm::vec3{1, 0, 0} + 1.0F * glm::vec3{r, r, 0});
  expect_near(glm::vec3{vertices[0].tangent}, expected);
}

TEST(Geometry, DegenerateCoordinatesGetSomeOrthonormalFrame) {
  Mesh plane = make_plane({2.0F, 2.0F}, {0.0F, 0.0F});
  compute_tangents(plane.vertices, plane.indices, {});
  for (const Vertex& vertex : plane.vertices) {
    EXPECT_NEAR(glm::length(glm::vec3{vertex.tangent}), 1.0F, 1e-6F);
    EXPECT_NEAR(glm::dot(glm::vec3{vertex.tangent}, vertex.normal), 0.0F, 1e-6F);
    EXPECT_EQ(std::abs(vertex.tangent.w), 1.0F);
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

TEST(Geometry, GivenTangentsAreMadeOrthonormal) {
  std::vector<Vertex> vertices(3);
  vertices[0].tangent = {3.0F, 0.0F, 4.0F, -0.5F};
  vertices[1].tangent = {0.0F, 0.0F, 1.0F, 1.0F};  // along the normal
  vertices[2].tangent = {std::numeric_limits<float>::infinity(), 0.0F, 0.0F, 1.0F};
  EXPECT_EQ(repair_tangents(vertices), 2U);
  expect_near(glm::vec3{vertices[0].tangent}, {1, 0, 0});
  EXPECT_EQ(vertices[0].tangent.w, -1.0F);
  for (const Vertex& vertex : vertices) EXPECT_NEAR(glm::length(glm::vec3{vertex.tangent}), 1.0F, 1e-6F);
}

}  // namespace
}  // namespace footprint
