// golden_armor: overlapping round scales of domed metal, each row over the next lower one, on a curved breast plate.
#include <cmath>
#include <numbers>

#include "renderer/core/numbers.hpp"
#include "scenes/surfaces/height.hpp"
#include "scenes/surfaces/meshes.hpp"
#include "scenes/surfaces/texel_grid.hpp"

namespace footprint::surfaces::golden_armor {
namespace {

/// Lengths on the map are in columns of scales: a scale is 1 wide, rows are half of that apart and every second one is
/// moved by half a scale. A scale is a disc of this radius, of which the rows above leave the lower part to be seen.
constexpr double scale_radius = 0.6;

/// The highest point of a scale's dome: the middle of its visible part, below the disc's centre.
constexpr double dome_drop = 0.24;

/// Radius around it that contains the visible part.
constexpr double dome_radius = 0.56;

/// The outer share of the disc that is bent down to an edge.
constexpr double lip = 0.9;

/// The dents of hammering on each scale: its tilt, as the x and y of its normal. Rows are twice as many as columns.
using Tilts = WrappedGrid<glm::dvec2>;

Tilts hammer(int columns, double unevenness, std::uint32_t seed) {
  std::mt19937_64 random(seed);
  Tilts tilts(columns, 2 * columns);
  for (glm::dvec2& tilt : tilts) {
    const double angle = 2.0 * std::numbers::pi * uniform(random), amount = std::sqrt(uniform(random));
    tilt = unevenness * amount * glm::dvec2{std::cos(angle), std::sin(angle)};
  }
  return tilts;
}

/// The x and y of the normal on a scale at `offset` from its disc's centre: as on a sphere, which at the lip's rim
/// would lean by arcsin `edge`; bent further down on the lip.
glm::dvec2 lean_of(const glm::dvec2& offset, double edge) {
  const glm::dvec2 from_top = (offset + glm::dvec2{0.0, dome_drop}) / dome_radius;
  const double out = glm::length(offset) / scale_radius;
  const double bent = std::max(0.0, (out - lip) / (1.0 - lip));
  const glm::dvec2 lean = edge * from_top + 0.4 * bent * offset / scale_radius;
  return lean * std::min(1.0, 0.98 / std::max(glm::length(lean), 1e-9));
}

/// The normal at `point`, in columns of scales.
glm::dvec3 normal_at(const glm::dvec2& point, double edge, const Tilts& tilts) {
  // From the highest row that can reach the point downwards, so that the first scale found is on top.
  const int top = static_cast<int>(std::floor(2.0 * (point.y + scale_radius)));
  for (int row = top;; --row) {
    const double shift = row % 2 == 0 ? 0.0 : 0.5;
    const double column = std::round(point.x - shift);
    const glm::dvec2 offset = point - glm::dvec2{column + shift, 0.5 * row};
    if (glm::dot(offset, offset) > scale_radius * scale_radius) continue;
    const glm::dvec2 lean = lean_of(offset, edge);
    const glm::dvec3 normal{lean, std::sqrt(1.0 - glm::dot(lean, lean))};
    return glm::normalize(normal + glm::dvec3{tilts.at(static_cast<int>(column), row), 0.0});
  }
}

Image normals(const SurfaceSettings& settings) {
  const Options& parameters = settings.parameters;
  const int count = static_cast<int>(parameters.number("count"));
  const double edge = std::sin(glm::radians(parameters.number("edge_degrees")));
  const Tilts tilts = hammer(count, parameters.number("unevenness"), settings.seed);
  return fill_normals(settings.resolution,
                      [&](const glm::dvec2& uv) { return normal_at(static_cast<double>(count) * uv, edge, tilts); });
}

Height bulge(const Height& at, double centre, double width) {
  const Height t = (at - centre) / width;
  return exp(-1.0 * t * t);
}

/// The breast plate at an angle around the body (radians, 0 in front) and a height (metres).
BentPoint plate_at(double angle_value, double height_value) {
  const HeightPoint at{{angle_value, height_value}};
  const Height &angle = at.x, &y = at.y;
  const Height across = 0.30 + 0.10 * smooth_step(y, -0.35, 0.15) - 0.05 * smooth_step(y, 0.1, 0.5);
  const Height deep = 0.23 + 0.045 * smooth_step(y, -0.4, 0.1) - 0.13 * smooth_step(y, 0.1, 0.55);
  const Height chest = 0.05 * (bulge(angle, -0.55, 0.42) + bulge(angle, 0.55, 0.42)) * bulge(y, 0.12, 0.19);
  const Height ridge = 0.018 * bulge(angle, 0.0, 0.13) * smooth_step(y, -0.5, -0.1);
  const Height reach = 1.0 + (chest + ridge) / 0.25;
  return {across * reach * sin(angle), y, deep * reach * cos(angle)};
}

/// Half the plate's width as an angle: wide at the ribs, cut out for the arms above.
double half_angle(double height) {
  const double t = glm::smoothstep(0.08, 0.34, height);
  return glm::mix(1.45, 0.92, t) - 0.1 * glm::smoothstep(0.0, -0.45, height);
}

Vertex plate_vertex(const glm::dvec2& st) {
  const double side = 2.0 * st.x - 1.0;
  const double top = 0.46 - 0.16 * std::exp(-(side * side) / 0.12), bottom = -0.44 - 0.1 * (1.0 - side * side);
  const double height = glm::mix(bottom, top, st.y), angle = side * half_angle(height);
  return bent_vertex(plate_at(angle, height), {0.4 * angle, -height});  // texture coordinates in metres, nearly
}

Mesh mesh(const SurfaceSettings& /*settings*/) {
  Mesh mesh = grid_mesh(80, 80, plate_vertex);
  mesh.name = "breast_plate";
  return mesh;
}

}  // namespace

Surface surface() {
  return {.name = "golden_armor",
          .summary = "a curved breast plate of overlapping domed scales",
          .parameters = {whole_option("count", 8, 1, 512, "columns of scales on the map; rows are twice as many"),
                         number_option("edge_degrees", 60.0, 0, 80, "tilt of a scale's dome at its edge, degrees"),
                         number_option("unevenness", 0.06, 0, 0.3,
                                       "largest tilt of a whole scale, as the sine of the angle")},
          .normals = normals,
          .mesh = mesh};
}

}  // namespace footprint::surfaces::golden_armor
