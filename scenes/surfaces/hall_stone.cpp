// hall_stone: the walls, columns, arches and the vault of a hall, of weathered ashlar.
#include <array>
#include <cmath>
#include <numbers>

#include "renderer/core/random.hpp"
#include "renderer/scene/geometry.hpp"
#include "scenes/surfaces/hall.hpp"
#include "scenes/surfaces/meshes.hpp"
#include "scenes/surfaces/octaves.hpp"
#include "scenes/surfaces/texel_grid.hpp"
#include "scenes/surfaces/wrapped_grid.hpp"

namespace footprint::surfaces::hall_stone {
namespace {

/// The map covers so many metres: four courses of two blocks.
constexpr double map_size = 2.0;
constexpr int courses = 4, blocks = 2;

/// Half the width of a joint, in heights of a course.
constexpr double joint = 0.025;

constexpr std::array<Octave, 4> weathering{{{9, 0.04}, {34, 0.07}, {120, 0.12}, {380, 0.16}}};
constexpr std::array<Octave, 3> stains{{{3, 0.6}, {11, 0.4}, {45, 0.3}}};

class Ashlar {
 public:
  explicit Ashlar(std::uint32_t seed) : Ashlar(std::mt19937_64(seed)) {}

  /// The height, in map widths: blocks stand out of their joints with rounded edges.
  [[nodiscard]] Height height(const HeightPoint& at) const {
    const Height row = static_cast<double>(courses) * at.y, column = static_cast<double>(blocks) * at.x + shift(row);
    const Height from_row = nearest_line(row),
                 from_column = (static_cast<double>(courses) / blocks) * nearest_line(column);
    const Height edge = from_row.value() < from_column.value() ? from_row : from_column;
    return 0.25 * joint / courses * smooth_step(edge, 0.3 * joint, 2.0 * joint) + weathering_.relief(at);
  }

  [[nodiscard]] bool is_joint(const glm::dvec2& uv) const {
    const HeightPoint at{uv};
    const Height row = static_cast<double>(courses) * at.y, column = static_cast<double>(blocks) * at.x + shift(row);
    return nearest_line(row).value() < joint || nearest_line(column).value() * courses / blocks < joint;
  }

  /// -1 to 1: of this block alone, with stains that run over all.
  [[nodiscard]] double tone(const glm::dvec2& uv) const {
    const int row = static_cast<int>(std::floor(courses * uv.y));
    const int column = static_cast<int>(std::floor(blocks * uv.x + (wrap(row, 2) == 0 ? 0.0 : 0.5)));
    return 0.6 * tones_.at(column, row) + stains_.value(uv);
  }

 private:
  explicit Ashlar(std::mt19937_64 random)
      : weathering_(weathering, random), stains_(stains, random), tones_(blocks, courses) {
    for (double& tone : tones_) tone = 2.0 * uniform(random) - 1.0;
  }

  static double shift(const Height& row) { return wrap(static_cast<int>(std::floor(row.value())), 2) == 0 ? 0.0 : 0.5; }

  /// The distance to the nearest whole number.
  static Height nearest_line(const Height& x) {
    const Height offset = x - std::round(x.value());
    return offset.value() < 0.0 ? Height(-offset) : offset;
  }

  OctaveNoise weathering_, stains_;
  WrappedGrid<double> tones_;
};

Image normals(const SurfaceSettings& settings) {
  const Ashlar ashlar(settings.seed);
  return fill_normals(settings.resolution,
                      [&](const glm::dvec2& uv) { return normal_of_slope(slope_of(ashlar.height(HeightPoint{uv}))); });
}

Image base_color(const SurfaceSettings& settings) {
  const Ashlar ashlar(settings.seed);
  return fill_colors(glm::ivec2{settings.resolution}, [&](const glm::dvec2& uv) {
    const glm::dvec3 stone = glm::dvec3{0.50, 0.41, 0.30} * (1.0 + 0.22 * ashlar.tone(uv));
    return glm::clamp(ashlar.is_joint(uv) ? 0.55 * stone : stone, 0.0, 1.0);
  });
}

Image exponents(const SurfaceSettings& settings) {
  const Ashlar ashlar(settings.seed);
  return fill_values(glm::ivec2{settings.resolution}, [&](const glm::dvec2& uv) {
    return ashlar.is_joint(uv) ? 4.0 : 14.0 * std::exp2(glm::clamp(ashlar.tone(uv), -2.0, 2.0));
  });
}

/// A column's radius at a height: moulded base, tapering shaft with a ring, flaring capital.
Height column_radius(const Height& y) {
  const auto ring = [&](double at, double width, double out) { return out * smooth_ridge((y - at) / width); };
  const Height shaft = 0.30 - 0.012 * y;
  const Height base = 0.18 * (1.0 - smooth_step(y, 0.05, 0.4)) + ring(0.5, 0.13, 0.06);
  const Height capital =
      0.22 * smooth_step(y, hall::spring - 0.6, hall::spring) + ring(hall::spring - 0.62, 0.13, 0.05);
  return shaft + base + capital;
}

Mesh column(double x, double z) {
  return grid_mesh(32, 110, [&](const glm::dvec2& st) {
    // Rows are closer together along the mouldings at both ends.
    const double share = st.y - 0.6 * std::sin(2.0 * std::numbers::pi * st.y) / (2.0 * std::numbers::pi);
    const HeightPoint at{{2.0 * std::numbers::pi * st.x, hall::spring * share}};
    const Height radius = column_radius(at.y);
    const BentPoint point{x + radius * sin(at.x), at.y, z + radius * cos(at.x)};
    return bent_vertex(point, {0.3 * at.x.value() / map_size, -at.y.value() / map_size});
  });
}

/// The face of one bay of the arcade over its arch, `side` 1 seen by whoever looks along -x, -1 along +x.
Mesh spandrel(double x, double side, int index) {
  const hall::Wall wall{{x, hall::spring, hall::bay_middle(index)}, {0.0, 0.0, -side}, {0.0, 1.0, 0.0}};
  return grid_mesh(32, 1, [&](const glm::dvec2& st) {
    const double angle = std::numbers::pi * (1.0 - st.x);
    const glm::dvec2 towards{std::cos(angle), std::sin(angle)};
    const double reach = 1.0 / std::max(std::abs(towards.x), towards.y);  // to the rectangle around the arch
    const glm::dvec2 frame = reach * towards * glm::dvec2{0.5 * hall::bay, hall::vault_spring - hall::spring};
    return wall.vertex(glm::mix(hall::arch_radius * towards, frame, st.y), map_size);
  });
}

/// The underside of an arch.
Mesh soffit(double x, int index) {
  return grid_mesh(32, 1, [&](const glm::dvec2& st) {
    const HeightPoint at{{std::numbers::pi * st.x, hall::arcade_half_thickness * (2.0 * st.y - 1.0)}};
    const BentPoint point{x + at.y, hall::spring + hall::arch_radius * sin(at.x),
                          hall::bay_middle(index) + hall::arch_radius * cos(at.x)};
    return bent_vertex(point, glm::dvec2{hall::arch_radius * at.x.value(), -at.y.value()} / map_size);
  });
}

/// The barrel vault over the nave, between the inner faces of the arcades.
Mesh vault() {
  constexpr double radius = hall::arcade - hall::arcade_half_thickness;
  return grid_mesh(48, 1, [=](const glm::dvec2& st) {
    const HeightPoint at{{std::numbers::pi * st.x, hall::length * st.y}};
    const BentPoint point{radius * cos(at.x), hall::vault_spring + radius * sin(at.x), -1.0 * at.y};
    return bent_vertex(point, glm::dvec2{radius * at.x.value(), -at.y.value()} / map_size);
  });
}

/// A rectangle of `size` on a wall, its lower left corner at the origin.
Mesh rectangle(const hall::Wall& wall, const glm::dvec2& size) {
  return grid_mesh(1, 1, [&](const glm::dvec2& st) { return wall.vertex(st * size, map_size); });
}

Mesh mesh(const SurfaceSettings& /*settings*/) {
  constexpr glm::dvec3 up{0.0, 1.0, 0.0}, right{1.0, 0.0, 0.0}, back{0.0, 0.0, -1.0};
  constexpr double width = 2.0 * hall::outer_wall;
  Mesh mesh = vault();
  for (const double side : {-1.0, 1.0}) {
    const double x = side * hall::arcade;
    for (int i = 0; i <= hall::bays; ++i) append(mesh, column(x, -hall::bay * i));
    for (int i = 0; i < hall::bays; ++i) {
      append(mesh, spandrel(x - side * hall::arcade_half_thickness, -side, i));
      append(mesh, spandrel(x + side * hall::arcade_half_thickness, side, i));
      append(mesh, soffit(x, i));
    }
    const double near_end = side < 0.0 ? 0.0 : -hall::length;
    append(mesh, rectangle({{side * hall::outer_wall, 0.0, near_end}, -side * back, up},
                           {hall::length, hall::aisle_ceiling}));
    append(
        mesh,
        rectangle({{side < 0.0 ? -hall::outer_wall : hall::arcade, hall::aisle_ceiling, -hall::length}, right, -back},
                  {hall::outer_wall - hall::arcade, hall::length}));
  }
  append(mesh, rectangle({{-hall::outer_wall, 0.0, -hall::length}, right, up}, {width, 10.0}));
  mesh.name = "hall";
  return mesh;
}

}  // namespace

Surface surface() {
  return {.name = "hall_stone",
          .summary = "walls, columns, arches and vault of a hall, of weathered ashlar",
          .parameters = {},
          .default_resolution = 1024,
          .normals = normals,
          .base_color = base_color,
          .lobe_parameter = exponents,
          .distribution = NormalDistribution::blinn_phong,
          .mesh = mesh};
}

}  // namespace footprint::surfaces::hall_stone
