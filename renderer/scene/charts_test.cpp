// Charts of small meshes whose islands are known.
#include "renderer/scene/charts.hpp"

#include <gtest/gtest.h>

namespace footprint {
namespace {

Material with_map(int set) {
  Material material;
  material.normal_map =
      TextureMap{"normals", std::make_shared<const Image>(1, 1, 4, 1.0F), TextureCoordinates{.set = set}};
  return material;
}

// Two triangles of a square, each with three vertices of its own; the second one's coordinates are moved by `shift`.
std::vector<Vertex> apart(float shift) {
  const auto at = [](float x, float y, float moved) {
    return Vertex{.position = {x, y, 0}, .uv0 = {x + moved, y}, .uv1 = {x, y}};
  };
  return {at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 0, shift), at(1, 1, shift), at(0, 1, shift)};
}

const std::vector<std::uint32_t> six{0, 1, 2, 3, 4, 5};

TEST(Charts, VerticesOfOnePlaceAndCoordinateAreOne) {
  const Charts charts = charts_of(apart(0.0F), six, with_map(0));
  EXPECT_EQ(charts.count, 1U);
  EXPECT_EQ(charts.of_vertex, std::vector<std::uint32_t>(6, 0U));
}

TEST(Charts, OtherCoordinatesPart) {
  const Charts charts = charts_of(apart(0.5F), six, with_map(0));
  EXPECT_EQ(charts.count, 2U);
  EXPECT_EQ(charts.of_vertex, (std::vector<std::uint32_t>{0, 0, 0, 1, 1, 1}));
}

TEST(Charts, CoordinatesThatNoMapReadsDoNotPart) {
  EXPECT_EQ(charts_of(apart(0.5F), six, with_map(1)).count, 1U);
  EXPECT_EQ(charts_of(apart(0.5F), six, Material{}).count, 1U);
}

TEST(Charts, OneVertexJoins) {
  std::vector<Vertex> vertices = apart(0.5F);
  vertices[3].uv0 = vertices[0].uv0;  // the corner (0, 0) alone agrees
  EXPECT_EQ(charts_of(vertices, six, with_map(0)).count, 1U);
}

TEST(Charts, NormalsDoNotPart) {
  std::vector<Vertex> vertices = apart(0.0F);
  for (std::size_t i = 3; i < 6; ++i) vertices[i].normal = {1, 0, 0};
  EXPECT_EQ(charts_of(vertices, six, with_map(0)).count, 1U);
}

TEST(Charts, ZeroHasOneSign) {
  std::vector<Vertex> vertices = apart(0.0F);
  vertices[3].position.y = -0.0F;
  vertices[4].uv0 = {7, 7};  // only the corner (0, 0) could join
  EXPECT_EQ(charts_of(vertices, six, with_map(0)).count, 1U);
}

TEST(Charts, NoVertexNoChart) { EXPECT_EQ(charts_of({}, {}, Material{}).count, 0U); }

}  // namespace
}  // namespace footprint
