// Turned solids against what geometry says of them, and the chessmen.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "scenes/surfaces/meshes.hpp"
#include "tests/support/mesh_area.hpp"
#include "tests/support/surface_meshes.hpp"

namespace footprint {
namespace {

using std::numbers::pi;

// The volume by the divergence theorem, for closed meshes only.
double volume(const Mesh& mesh) {
  double sum = 0.0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const glm::dvec3 a = mesh.vertices[mesh.indices[i]].position, b = mesh.vertices[mesh.indices[i + 1]].position,
                     c = mesh.vertices[mesh.indices[i + 2]].position;
    sum += glm::dot(a, glm::cross(b, c)) / 6.0;
  }
  return sum;
}

TEST(TurnedSolid, HasTheAreaAndVolumeOfAConeOnACylinder) {
  const std::array<Cut, 3> cuts{{{{2.0, 0.0}}, {{2.0, 3.0}}, {{0.0, 4.5}}}};
  const Mesh mesh = turned_mesh({.cuts = cuts}, 400, 0.5);
  EXPECT_NEAR(testing::mesh_area(mesh), pi * (4.0 + 12.0 + 2.0 * 2.5), 0.01);
  EXPECT_NEAR(volume(mesh), pi * (12.0 + 2.0), 0.01);
}

TEST(TurnedSolid, HasTheAreaAndVolumeOfABallThatBulgesAndOfAHollowOne) {
  const double quarter = std::tan(pi / 8.0);
  const std::array<Cut, 2> ball{{{{1.0, 0.0}, quarter}, {{0.0, 1.0}, quarter}}};
  const Mesh mesh = turned_mesh({.start = -1.0, .cuts = ball}, 400, 0.01);
  EXPECT_NEAR(testing::mesh_area(mesh), 4.0 * pi, 0.002);
  EXPECT_NEAR(volume(mesh), 4.0 / 3.0 * pi, 0.002);
  for (const Vertex& vertex : mesh.vertices) ASSERT_LT(glm::distance(vertex.position, vertex.normal), 1e-5F);
  // A cylinder of radius and height 1, less a quarter circle's ring from its upper edge: Pappus.
  const std::array<Cut, 2> bell{{{{1.0, 0.0}}, {{0.0, 1.0}, -quarter}}};
  const double hollow = 0.25 * pi, from_axis = 1.0 - 4.0 / (3.0 * pi);
  EXPECT_NEAR(volume(turned_mesh({.cuts = bell}, 400, 0.01)), pi - 2.0 * pi * from_axis * hollow, 0.002);
}

TEST(Sphere, IsTheUnitSphereAndItsMapsUprightAxisIsY) {
  const Mesh mesh = testing::make_mesh("sphere");
  EXPECT_NEAR(volume(mesh), 4.0 / 3.0 * pi, 0.01);
  for (const Vertex& vertex : mesh.vertices) {
    ASSERT_LT(glm::distance(vertex.position, vertex.normal), 1e-5F);
    ASSERT_NEAR(vertex.tangent.y, 0.0F, 1e-5F);
  }
}

class Chessman : public ::testing::TestWithParam<std::string> {
 protected:
  const Mesh mesh_ = testing::make_mesh("chess_piece", {{"piece", GetParam()}});
};

TEST_P(Chessman, HasASoundMesh) {
  testing::expect_unit_frames(mesh_);
  testing::expect_faces_its_normals(mesh_);
  testing::expect_map_along_tangents(mesh_);
}

TEST_P(Chessman, IsOnItsSquare) {
  float lowest = 1.0F, widest = 0.0F;
  for (const Vertex& vertex : mesh_.vertices) {
    lowest = std::min(lowest, vertex.position.y);
    widest = std::max(widest, glm::length(glm::vec2(vertex.position.x, vertex.position.z)));
  }
  EXPECT_EQ(lowest, 0.0F);
  EXPECT_GT(widest, 0.012F);
  EXPECT_LT(widest, 0.0285F);
}

INSTANTIATE_TEST_SUITE_P(All, Chessman, ::testing::Values("pawn", "rook", "knight", "bishop", "queen", "king"),
                         [](const auto& row) { return row.param; });

TEST(Chessmen, AreOfTheHeightsThatTellThemApart) {
  double last = 0.0;
  for (const std::string piece : {"pawn", "rook", "knight", "bishop", "queen", "king"}) {
    const Mesh mesh = testing::make_mesh("chess_piece", {{"piece", piece}});
    const auto top = std::ranges::max_element(mesh.vertices, {}, [](const Vertex& v) { return v.position.y; });
    EXPECT_GT(top->position.y, last + 0.003) << piece;
    last = top->position.y;
  }
  EXPECT_LT(last, 0.1);
}

TEST(ChessBoard, HasSquaresOfTwoColoursAndADarkOneAtTheLowerLeft) {
  const Surface& surface = find_surface(all_surfaces(), "chess_board");
  SurfaceSettings settings = surface_settings(surface, {});
  settings.resolution = 16;
  const Image colors = surface_map(surface, settings, &Surface::base_color);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      ASSERT_EQ(colors.at(x, y)[0] < 0.2F, (x / 2 + (15 - y) / 2) % 2 == 0);
    }
  }
}

}  // namespace
}  // namespace footprint
