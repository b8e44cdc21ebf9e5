// chess_board: a board of inlaid wood without relief.
#include <cmath>

#include "renderer/scene/geometry.hpp"
#include "scenes/surfaces/texel_grid.hpp"
#include "scenes/surfaces/turned.hpp"

namespace footprint::surfaces::chess_board {
namespace {

constexpr int squares = 8;

/// Metres; the field lies a little over its frame.
constexpr double square = 0.057, frame = 0.024, inlay = 0.0015, thickness = 0.02;

Image base_color(const SurfaceSettings& settings) {
  return fill_colors(glm::ivec2{settings.resolution}, [](const glm::dvec2& uv) {
    const glm::ivec2 at = glm::ivec2(glm::floor(static_cast<double>(squares) * uv));
    return (at.x + at.y) % 2 == 0 ? glm::dvec3{0.09, 0.035, 0.016} : glm::dvec3{0.55, 0.37, 0.20};
  });
}

/// A flat side: its middle, and half its width and height. The part of the map is the lower left square's or all.
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

}  // namespace footprint::surfaces::chess_board
