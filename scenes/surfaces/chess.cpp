// chess_piece: the six Staunton chessmen, turned, with a carved crown, a cross or a horse's head on top.
// chess_board: a board of inlaid wood without relief.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "renderer/scene/geometry.hpp"
#include "scenes/surfaces/meshes.hpp"
#include "scenes/surfaces/texel_grid.hpp"

namespace footprint {

namespace surfaces::chess_piece {
namespace {

using std::numbers::pi;

// All lengths are millimetres; the mesh is in metres.
constexpr int around = 56;
constexpr double row = 3.5;

/// The bulge of an arc of `degrees`.
double arc(double degrees) { return std::tan(degrees * pi / 720.0); }

/// A foot of that radius, then `rest`.
std::vector<Cut> on_foot(double radius, std::initializer_list<Cut> rest) {
  std::vector<Cut> cuts{{{radius, 0.0}}, {{radius, 3.0}}, {{0.93 * radius, 7.5}, 0.4}, {{0.8 * radius, 9.0}}};
  cuts.push_back({{0.76 * radius, 11.5}, 0.5});
  cuts.insert(cuts.end(), rest);
  return cuts;
}

Mesh turn(const std::vector<Cut>& cuts, int waves = 0) { return turned_mesh({0.0, cuts, waves}, around, row); }

/// A point of a block from its coordinates in the unit cube.
using BlockPoint = std::function<BentPoint(const Height& x, const Height& y, const Height& z)>;

/// The six sides of a block, whose formula must not mirror it.
Mesh block_mesh(int cells, const BlockPoint& point) {
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool upper : {false, true}) {
      append(mesh, grid_mesh(cells, cells, [&](const glm::dvec2& st) {
               const HeightPoint at{st};
               std::array<Height, 3> cube{Height{upper ? 1.0 : 0.0}, upper ? at.x : at.y, upper ? at.y : at.x};
               std::rotate(cube.begin(), cube.end() - axis, cube.end());
               return bent_vertex(point(cube[0], cube[1], cube[2]), {st.x, 1.0 - st.y});
             }));
    }
  }
  return mesh;
}

/// A box between two corners.
Mesh box_mesh(const glm::dvec3& low, const glm::dvec3& high) {
  const glm::dvec3 size = high - low;
  return block_mesh(1, [&](const Height& x, const Height& y, const Height& z) -> BentPoint {
    return {low.x + size.x * x, low.y + size.y * y, low.z + size.z * z};
  });
}

Mesh pawn() {
  return turn(on_foot(
      14.5, {{{5.2, 27.0}, -0.25}, {{8.6, 28.5}}, {{8.6, 30.0}, 0.5}, {{4.5, 31.5}}, {{0.0, 46.1}, arc(145.7)}}));
}

/// The battlements stand on a flat top.
Mesh rook() {
  Mesh mesh = turn(on_foot(16.0, {{{8.5, 36.0}, -0.15},
                                  {{12.0, 38.0}},
                                  {{12.0, 40.0}, 0.5},
                                  {{10.5, 41.5}},
                                  {{12.5, 48.0}, -0.12},
                                  {{0.0, 48.0}}}));
  constexpr int merlons = 6;
  constexpr double width = 42.0 * pi / 180.0;
  for (int i = 0; i < merlons; ++i) {
    const double first = 2.0 * pi * i / merlons;
    append(mesh, block_mesh(6, [&](const Height& x, const Height& y, const Height& z) -> BentPoint {
             const Height angle = first + width * x, radius = 8.5 + 4.0 * z;
             return {radius * sin(angle), 48.0 + 7.0 * y, radius * cos(angle)};
           }));
  }
  return mesh;
}

Mesh bishop() {
  return turn(on_foot(15.5, {{{5.0, 42.0}, -0.2},
                             {{9.5, 44.0}},
                             {{9.5, 45.5}, 0.5},
                             {{6.0, 47.0}},
                             {{7.0, 49.0}},
                             {{1.5, 67.0}, 0.36},
                             {{0.0, 71.7}, arc(144.8)}}));
}

Mesh queen() {
  constexpr int points = 8;
  return turn(on_foot(18.0, {{{5.5, 56.0}, -0.2},
                             {{11.0, 58.0}},
                             {{11.0, 60.0}, 0.5},
                             {{7.5, 61.5}},
                             {{7.5, 63.0}},
                             {{12.5, 76.0}, -0.18, 0.8},
                             {{10.5, 76.0}, 0.0, 0.8},
                             {{9.0, 74.0}},
                             {{2.2, 78.5}, 0.25},
                             {{0.0, 83.5}, arc(132.8)}}),
              points);
}

Mesh king() {
  Mesh mesh = turn(on_foot(19.0, {{{6.2, 64.0}, -0.2},
                                  {{12.0, 66.0}},
                                  {{12.0, 68.5}, 0.5},
                                  {{8.0, 70.0}},
                                  {{8.0, 71.5}},
                                  {{12.0, 83.0}, -0.1},
                                  {{3.0, 87.0}, 0.2},
                                  {{3.0, 88.5}},
                                  {{0.0, 88.5}}}));
  append(mesh, box_mesh({-1.7, 88.0, -1.3}, {1.7, 99.0, 1.3}));
  append(mesh, box_mesh({-4.6, 92.0, -1.2}, {4.6, 95.4, 1.2}));
  return mesh;
}

/// A cross section of a limb that bends in the xy plane.
struct Rib {
  double x, y;        ///< of its middle
  double degrees;     ///< the limb's direction: 90 upwards, 0 along x
  double half_width;  ///< in the plane
  double half_depth;  ///< along z
};

/// The uniform cubic B-spline of one number of the ribs, `at` 0 to 1.
Height spline(std::span<const Rib> ribs, double Rib::*number, const Height& at) {
  const auto spans = static_cast<double>(ribs.size() - 3);
  const auto first = static_cast<std::size_t>(std::clamp(std::floor(spans * at.value()), 0.0, spans - 1.0));
  const Height t = spans * at - static_cast<double>(first), s = 1.0 - t;
  const auto rib = [&](std::size_t i) { return ribs[first + i].*number; };
  return (rib(0) * s * s * s + rib(1) * (3.0 * t * t * t - 6.0 * t * t + 4.0) +
          rib(2) * (3.0 * s * s * s - 6.0 * s * s + 4.0) + rib(3) * t * t * t) /
         6.0;
}

/// A limb with oval ribs, rounded at its far end.
Mesh limb_mesh(std::span<const Rib> ribs) {
  constexpr double rounded = 0.86;  // where the rounding begins
  const auto point = [&](const HeightPoint& st) -> BentPoint {
    Height at = st.y, closing{1.0};
    if (st.y.value() > rounded) {
      const Height angle = 0.5 * pi * (st.y - rounded) / (1.0 - rounded);
      at = rounded + (1.0 - rounded) * sin(angle);
      closing = cos(angle);
    }
    const Height direction = spline(ribs, &Rib::degrees, at) * (pi / 180.0), turn = 2.0 * pi * st.x;
    const Height across = closing * spline(ribs, &Rib::half_width, at) * cos(turn);
    return {spline(ribs, &Rib::x, at) + across * sin(direction), spline(ribs, &Rib::y, at) - across * cos(direction),
            -1.0 * closing * spline(ribs, &Rib::half_depth, at) * sin(turn)};
  };
  return pinched_grid_mesh(40, 40, point, [](const glm::dvec2& st) { return glm::dvec2{st.x, 1.0 - st.y}; });
}

/// The horse looks along x.
Mesh knight() {
  Mesh mesh = turn(on_foot(15.5, {{{11.0, 14.0}, -0.3}, {{11.0, 15.5}, 0.5}, {{0.0, 15.5}}}));
  constexpr std::array<Rib, 11> head{{{0.0, 4.0, 90.0, 10.5, 9.5},
                                      {-1.5, 12.0, 90.0, 10.4, 9.0},
                                      {-3.5, 20.0, 88.0, 10.0, 8.0},
                                      {-5.5, 28.0, 84.0, 9.4, 7.0},
                                      {-6.0, 36.0, 80.0, 8.8, 6.2},
                                      {-4.0, 43.5, 53.0, 8.2, 5.8},
                                      {1.0, 47.5, 5.0, 7.8, 5.4},
                                      {7.0, 45.5, -33.0, 6.4, 4.8},
                                      {12.0, 41.0, -46.0, 4.8, 4.0},
                                      {16.0, 36.5, -48.0, 4.6, 3.8},
                                      {21.0, 31.0, -48.0, 4.8, 3.6}}};
  constexpr std::array<Rib, 8> mane{{{-9.0, 14.0, 100.0, 3.0, 1.6},
                                     {-10.5, 20.0, 98.0, 3.2, 1.8},
                                     {-12.5, 28.0, 94.0, 3.6, 1.8},
                                     {-13.5, 36.0, 84.0, 3.8, 1.8},
                                     {-12.0, 44.0, 66.0, 3.8, 1.8},
                                     {-7.5, 51.0, 40.0, 3.6, 1.7},
                                     {-1.0, 54.0, 5.0, 2.6, 1.5},
                                     {5.0, 53.0, -20.0, 1.8, 1.2}}};
  append(mesh, limb_mesh(head));
  append(mesh, limb_mesh(mane));
  for (const double side : {-1.0, 1.0}) {
    const std::array<Cut, 2> ear{{{{2.0, 50.0}}, {{0.0, 60.0}, 0.15}}};
    Mesh cone = turned_mesh({.start = 50.0, .cuts = ear}, 16, row);
    for (Vertex& vertex : cone.vertices) vertex.position += glm::vec3(-1.0, 0.0, 3.0 * side);
    append(mesh, cone);
  }
  return mesh;
}

using Maker = Mesh (*)();
constexpr std::array<std::pair<const char*, Maker>, 6> pieces{
    {{"pawn", pawn}, {"rook", rook}, {"knight", knight}, {"bishop", bishop}, {"queen", queen}, {"king", king}}};

Mesh mesh(const SurfaceSettings& settings) {
  const std::string& name = settings.parameters.word("piece");
  Mesh mesh = std::ranges::find(pieces, name, [](const auto& piece) { return piece.first; })->second();
  for (Vertex& vertex : mesh.vertices) vertex.position *= 1e-3F;
  mesh.name = name;
  return mesh;
}

}  // namespace

Surface surface() {
  std::vector<std::string> names;
  names.reserve(pieces.size());
  for (const auto& piece : pieces) names.emplace_back(piece.first);
  return {.name = "chess_piece",
          .summary = "a chessman 46 to 99 mm high on the origin, without relief; the map runs around it",
          .parameters = {word_option("piece", names, "which one")},
          .default_resolution = 512,
          .normals = flat_normals,
          .mesh = mesh};
}

}  // namespace surfaces::chess_piece

namespace surfaces::chess_board {
namespace {

constexpr int squares = 8;

/// Metres. The field is slightly higher than its frame.
constexpr double square = 0.057, frame = 0.024, inlay = 0.0015, thickness = 0.02;

Image base_color(const SurfaceSettings& settings) {
  return fill_map(glm::ivec2{settings.resolution}, 4, [](const glm::dvec2& uv) {
    const glm::ivec2 at = glm::ivec2(glm::floor(static_cast<double>(squares) * uv));
    return (at.x + at.y) % 2 == 0 ? glm::dvec3{0.09, 0.035, 0.016} : glm::dvec3{0.55, 0.37, 0.20};
  });
}

/// A flat side: its middle, and half its width and height. `part` of the map covers it: the lower left square, or all.
Mesh side(const glm::dvec3& middle, const glm::dvec3& right, const glm::dvec3& up, double part) {
  return grid_mesh(24, 24, [&](const glm::dvec2& st) {
    const HeightPoint at{2.0 * st - 1.0};
    const auto along = [&](int axis) -> Height { return middle[axis] + right[axis] * at.x + up[axis] * at.y; };
    return bent_vertex({along(0), along(1), along(2)}, {part * st.x, 1.0 - part * st.y});
  });
}

Mesh mesh(const SurfaceSettings& /*settings*/) {
  constexpr double half_field = 0.5 * squares * square, half = half_field + frame, low = -0.5 * thickness - inlay;
  constexpr double wood = 0.9 / squares;
  const glm::dvec3 x(1.0, 0.0, 0.0), y(0.0, 0.5 * thickness, 0.0), z(0.0, 0.0, 1.0);
  Mesh mesh = side(glm::dvec3(0.0), half_field * x, -half_field * z, 1.0);
  append(mesh, side({0.0, -inlay, 0.0}, half * x, -half * z, wood));
  append(mesh, side({0.0, low, half}, half * x, y, wood));
  append(mesh, side({0.0, low, -half}, -half * x, y, wood));
  append(mesh, side({half, low, 0.0}, -half * z, y, wood));
  append(mesh, side({-half, low, 0.0}, half * z, y, wood));
  mesh.name = "chess_board";
  return mesh;
}

}  // namespace

Surface surface() {
  return {.name = "chess_board",
          .summary = "a board of 8 x 8 squares of 57 mm, of walnut and maple, without relief; the field is at height 0",
          .parameters = {},
          .default_resolution = 512,
          .normals = flat_normals,
          .base_color = base_color,
          .mesh = mesh};
}

}  // namespace surfaces::chess_board

}  // namespace footprint
