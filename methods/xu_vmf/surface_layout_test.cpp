// Layouts of triangles in texture space: which map serves as it is, what an atlas keeps, and where there is none.
#include "methods/xu_vmf/surface_layout.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/scene/geometry.hpp"

namespace footprint::xu_vmf {
namespace {

TriangleSoup plane(const glm::vec2& tiling) {
  const Mesh mesh = make_plane({1, 1}, tiling);
  return {mesh.vertices, mesh.indices};
}

// Both, the second moved in texture coordinates.
TriangleSoup joined(TriangleSoup a, const TriangleSoup& b, const glm::vec2& moved) {
  const auto base = static_cast<std::uint32_t>(a.vertices.size());
  for (Vertex vertex : b.vertices) {
    vertex.uv0 += moved;
    a.vertices.push_back(vertex);
  }
  for (const std::uint32_t index : b.indices) a.indices.push_back(base + index);
  return a;
}

TEST(SurfaceLayout, IsTheMapsOwnWhereItIsUnique) {
  const TriangleSoup once = plane({1, 1});
  const SurfaceLayout layout = lay_out(once, {}, {64, 32});
  EXPECT_TRUE(layout.unique);
  EXPECT_EQ(layout.size, glm::ivec2(64, 32));
  EXPECT_TRUE(layout.note.empty());
  ASSERT_EQ(layout.coordinates.size(), once.vertices.size());
  for (std::size_t i = 0; i < once.vertices.size(); ++i) {
    EXPECT_NEAR(layout.coordinates[i].x, once.vertices[i].uv0.x, 1e-6F);
    EXPECT_NEAR(layout.coordinates[i].y, once.vertices[i].uv0.y, 1e-6F);
  }
}

TEST(SurfaceLayout, UnrollsTilesTexelByTexel) {
  const TriangleSoup tiled = plane({3, 2});
  const SurfaceLayout layout = lay_out(tiled, {}, {20, 10});
  EXPECT_TRUE(layout.unique);
  EXPECT_FALSE(layout.note.empty());
  EXPECT_GE(layout.size.x, 60 + chart_gap);
  EXPECT_GE(layout.size.y, 20 + chart_gap);
  for (std::size_t i = 0; i < tiled.vertices.size(); ++i) {
    const glm::dvec2 shift = glm::dvec2(layout.coordinates[i]) * glm::dvec2(layout.size) -
                             glm::dvec2(tiled.vertices[i].uv0) * glm::dvec2(20, 10);
    EXPECT_NEAR(shift.x, std::round(shift.x), 1e-4);
    EXPECT_NEAR(shift.y, std::round(shift.y), 1e-4);
  }
}

TEST(SurfaceLayout, GivesChartsThatShareTexelsPlacesApart) {
  const TriangleSoup half = plane({0.5F, 0.5F});
  EXPECT_TRUE(lay_out(joined(half, half, {0.5F, 0.5F}), {}, {32, 32}).note.empty());
  const SurfaceLayout layout = lay_out(joined(half, half, {0.25F, 0.25F}), {}, {32, 32});
  EXPECT_TRUE(layout.unique);
  EXPECT_NE(layout.note.find("2 charts"), std::string::npos) << layout.note;
  glm::vec2 lower[2]{glm::vec2(1e9F), glm::vec2(1e9F)}, upper[2]{glm::vec2(-1e9F), glm::vec2(-1e9F)};
  for (std::size_t i = 0; i < 8; ++i) {
    const glm::vec2 texel = layout.coordinates[i] * glm::vec2(layout.size);
    lower[i / 4] = glm::min(lower[i / 4], texel);
    upper[i / 4] = glm::max(upper[i / 4], texel);
  }
  const glm::vec2 gap = glm::max(lower[0] - upper[1], lower[1] - upper[0]);
  EXPECT_GE(std::max(gap.x, gap.y), static_cast<float>(chart_gap) - 0.01F);
}

TEST(SurfaceLayout, SaysWhereThereIsNone) {
  TriangleSoup folded = plane({1, 1});  // the second triangle lies over the first
  folded.vertices.push_back(folded.vertices[folded.indices[0]]);
  folded.indices.insert(folded.indices.end(), {folded.indices[0], folded.indices[1], folded.indices[2]});
  TriangleSoup broken = plane({1, 1});
  broken.vertices[0].uv0.x = std::numeric_limits<float>::quiet_NaN();
  for (const TriangleSoup& soup : {folded, broken, plane({400, 400})}) {
    const SurfaceLayout layout = lay_out(soup, {}, {256, 256});
    EXPECT_FALSE(layout.unique);
    EXPECT_FALSE(layout.note.empty());
    EXPECT_EQ(layout.coordinates.size(), soup.vertices.size());
  }
}

// Few texels in all, but more in a row than a texture may have.
TEST(SurfaceLayout, SaysWhereATextureWouldBeTooLong) {
  EXPECT_TRUE(lay_out(plane({200, 1}), {}, {64, 64}).unique);
  const SurfaceLayout layout = lay_out(plane({300, 1}), {}, {64, 64});
  EXPECT_FALSE(layout.unique);
  EXPECT_NE(layout.note.find("16384 along a side"), std::string::npos) << layout.note;
}

// Nothing would be drawn of what lies on a line or a point of the map, as where a model has no coordinates.
TEST(SurfaceLayout, SaysWhereTheSurfaceHasNoTexels) {
  TriangleSoup point = plane({1, 1});
  for (Vertex& vertex : point.vertices) vertex.uv0 = {0.3F, 0.4F};
  TriangleSoup line = plane({1, 1});
  for (Vertex& vertex : line.vertices) vertex.uv0.y = 0.4F;
  TriangleSoup slant = plane({1, 1});
  for (Vertex& vertex : slant.vertices) vertex.uv0 = glm::vec2(0.1F + 0.7F * vertex.uv0.x);
  const TriangleSoup half = joined(plane({0.5F, 0.5F}), point, {0.3F, 0.3F});
  const TriangleSoup tiny = joined(plane({1, 1}), plane({1e-3F, 1e-3F}), {1.5F, 0.0F});  // the second in an atlas
  for (const TriangleSoup& soup : {point, line, slant, half, tiny}) {
    for (const glm::ivec2 size : {glm::ivec2(4, 4), glm::ivec2(33, 64)}) {
      const SurfaceLayout layout = lay_out(soup, {}, size);
      EXPECT_FALSE(layout.unique);
      EXPECT_NE(layout.note.find("without a texel"), std::string::npos) << layout.note;
    }
  }
}

// A sliver and a triangle that is a point on the surface take nothing away.
TEST(SurfaceLayout, MindsNoTriangleWithoutArea) {
  TriangleSoup soup = plane({1, 1});
  soup.indices.insert(soup.indices.end(), {0, 1, 1, 2, 2, 2});
  const SurfaceLayout layout = lay_out(soup, {}, {64, 64});
  EXPECT_TRUE(layout.unique);
  EXPECT_TRUE(layout.note.empty());
}

TEST(SurfaceLayout, IsDefinedForNothing) { EXPECT_TRUE(lay_out({}, {}, {4, 4}).unique); }

}  // namespace
}  // namespace footprint::xu_vmf
