// hall_stone, hall_floor, hall_cloth: the walls, the floor and the curtains of one hall.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "renderer/core/numbers.hpp"
#include "renderer/scene/geometry.hpp"
#include "renderer/scene/surface.hpp"
#include "scenes/surfaces/height.hpp"
#include "scenes/surfaces/jacquard.hpp"
#include "scenes/surfaces/meshes.hpp"
#include "scenes/surfaces/texel_grid.hpp"

namespace footprint {

// The measures of the hall: a nave between two rows of columns with arches, and an aisle on either side. y is up, and
// the nave runs from z = 0 to -z.
namespace hall {
// Metres.
inline constexpr int bays = 6;
inline constexpr double bay = 3.0, length = bay * bays;
inline constexpr double arcade = 2.6;                      ///< from the nave's middle line to the columns' axes
inline constexpr double arcade_half_thickness = 0.28;      ///< of the wall over the columns
inline constexpr double outer_wall = 5.2;                  ///< from the middle line
inline constexpr double spring = 3.7, arch_radius = 1.12;  ///< height at which arches begin, and their radius
inline constexpr double aisle_ceiling = 5.6, vault_spring = 6.6;

/// The middle of a bay, 0 the nearest.
[[nodiscard]] constexpr double bay_middle(int index) { return -bay * (index + 0.5); }

/// A plane of the hall: its origin, and the directions right and up as a viewer sees them.
struct Wall {
  glm::dvec3 origin, right, up;

  /// The vertex at a point of it, in metres; texture coordinates in units of `map_size` metres.
  [[nodiscard]] Vertex vertex(const glm::dvec2& point, double map_size) const {
    Vertex vertex;
    vertex.position = origin + point.x * right + point.y * up;
    vertex.normal = glm::cross(right, up);
    vertex.tangent = {glm::vec3{right}, 1.0F};
    vertex.uv0 = vertex.uv1 = glm::dvec2{point.x, -point.y} / map_size;
    return vertex;
  }
};

}  // namespace hall

namespace surfaces::hall_stone {
namespace {

/// Metres that the map covers: four courses of two blocks.
constexpr double map_size = 2.0;
constexpr int courses = 4, blocks = 2;

/// Half the width of a joint, in heights of a course.
constexpr double joint = 0.025;

constexpr std::array<Octave, 4> weathering{{{9, 0.04}, {34, 0.07}, {120, 0.12}, {380, 0.16}}};
constexpr std::array<Octave, 3> stains{{{3, 0.6}, {11, 0.4}, {45, 0.3}}};

class Ashlar {
 public:
  explicit Ashlar(const SurfaceSettings& settings) : random_(settings.seed) {
    for (double& tone : tones_) tone = 2.0 * uniform(random_) - 1.0;
  }

  [[nodiscard]] glm::dvec3 normal(const glm::dvec2& uv) const {
    return normal_of_slope(slope_of(height(HeightPoint{uv})));
  }
  [[nodiscard]] glm::dvec3 color(const glm::dvec2& uv) const {
    const glm::dvec3 stone = glm::dvec3{0.50, 0.41, 0.30} * (1.0 + 0.22 * tone(uv));
    return glm::clamp(is_joint(uv) ? 0.55 * stone : stone, 0.0, 1.0);
  }
  [[nodiscard]] double exponent(const glm::dvec2& uv) const {
    return is_joint(uv) ? 4.0 : 14.0 * std::exp2(glm::clamp(tone(uv), -2.0, 2.0));
  }

 private:
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

  /// The tone of the block, with stains that cross blocks: -1 to 1.
  [[nodiscard]] double tone(const glm::dvec2& uv) const {
    const int row = static_cast<int>(std::floor(courses * uv.y));
    const int column = static_cast<int>(std::floor(blocks * uv.x + (wrap(row, 2) == 0 ? 0.0 : 0.5)));
    return 0.6 * tones_.at(column, row) + stains_.value(uv);
  }

  static double shift(const Height& row) { return wrap(static_cast<int>(std::floor(row.value())), 2) == 0 ? 0.0 : 0.5; }

  /// The distance to the nearest whole number.
  static Height nearest_line(const Height& x) {
    const Height offset = x - std::round(x.value());
    return offset.value() < 0.0 ? Height(-offset) : offset;
  }

  std::mt19937_64 random_;
  OctaveNoise weathering_{weathering, random_}, stains_{stains, random_};
  WrappedGrid<double> tones_{blocks, courses};
};

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
          .normals = map_of<4, &Ashlar::normal>,
          .base_color = map_of<4, &Ashlar::color>,
          .lobe_parameter = map_of<1, &Ashlar::exponent>,
          .distribution = NormalDistribution::blinn_phong,
          .mesh = mesh};
}

}  // namespace surfaces::hall_stone

namespace surfaces::hall_floor {
namespace {

/// Metres and squares that the map covers in each direction; the squares are even in number, so that they alternate.
constexpr double map_size = 3.0;
constexpr int squares = 8;

/// Half the width of a joint, in squares.
constexpr double joint = 0.012;

constexpr std::array<Octave, 3> waviness{{{20, 0.006}, {80, 0.012}, {330, 0.02}}};
constexpr std::array<Octave, 4> veins{{{4, 1.0}, {11, 0.5}, {31, 0.25}, {90, 0.12}}};

struct Stone {
  glm::dvec3 color, vein_color;
  double exponent;
};

constexpr Stone black{{0.025, 0.027, 0.03}, {0.30, 0.30, 0.28}, 900.0};
constexpr Stone white{{0.62, 0.58, 0.50}, {0.34, 0.32, 0.30}, 70.0};
constexpr Stone red{{0.30, 0.055, 0.035}, {0.55, 0.33, 0.28}, 300.0};
constexpr Stone cement{{0.30, 0.28, 0.25}, {0.30, 0.28, 0.25}, 5.0};

/// The stone at a point, and the tilt of its square.
struct Slab {
  Stone stone;
  glm::dvec2 slope;
};

class Paving {
 public:
  explicit Paving(const SurfaceSettings& settings) : random_(settings.seed) {
    const double tilt = std::tan(glm::radians(settings.parameters.number("tilt_degrees")));
    for (glm::dvec2& slope : slopes_) slope = tilt * (2.0 * glm::dvec2{uniform(random_), uniform(random_)} - 1.0);
  }

  [[nodiscard]] glm::dvec3 normal(const glm::dvec2& uv) const {
    return normal_of_slope(at(uv).slope + slope_of(waviness_.relief(HeightPoint{uv})));
  }
  [[nodiscard]] glm::dvec3 color(const glm::dvec2& uv) const {
    const Stone stone = at(uv).stone;
    const double vein = std::pow(1.0 - std::min(1.0, 4.0 * std::abs(veins_.value(uv))), 3.0);
    return glm::mix(stone.color, stone.vein_color, vein);
  }
  [[nodiscard]] double exponent(const glm::dvec2& uv) const { return at(uv).stone.exponent; }

 private:
  [[nodiscard]] Slab at(const glm::dvec2& uv) const {
    const glm::dvec2 cell = static_cast<double>(squares) * uv;
    const int column = static_cast<int>(std::floor(cell.x)), row = static_cast<int>(std::floor(cell.y));
    const glm::dvec2 offset = glm::abs(cell - glm::dvec2(column, row) - 0.5);  // from the middle
    const double out = std::max(offset.x, offset.y), lozenge = offset.x + offset.y;
    const bool dark = wrap(column + row, 2) == 0;
    Slab slab{dark ? black : white, slopes_.at(column, row)};
    if (dark && lozenge < 0.34) slab.stone = red;
    if (out > 0.5 - joint || (dark && std::abs(lozenge - 0.34) < joint)) slab = {cement, glm::dvec2{0.0}};
    return slab;
  }

  std::mt19937_64 random_;
  OctaveNoise waviness_{waviness, random_}, veins_{veins, random_};
  WrappedGrid<glm::dvec2> slopes_{squares, squares};
};

Mesh mesh(const SurfaceSettings& /*settings*/) {
  const hall::Wall ground{{-hall::outer_wall, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, -1.0}};
  Mesh mesh = grid_mesh(1, 1, [&](const glm::dvec2& st) {
    return ground.vertex(st * glm::dvec2{2.0 * hall::outer_wall, hall::length}, map_size);
  });
  mesh.name = "floor";
  return mesh;
}

}  // namespace

Surface surface() {
  return {.name = "hall_floor",
          .summary = "the floor of a hall: squares of polished and honed marble with inlaid lozenges",
          .parameters = {number_option("tilt_degrees", 0.7, 0, 30, "largest tilt of a square along x and y, degrees")},
          .default_resolution = 2048,
          .normals = map_of<4, &Paving::normal>,
          .base_color = map_of<4, &Paving::color>,
          .lobe_parameter = map_of<1, &Paving::exponent>,
          .distribution = NormalDistribution::blinn_phong,
          .mesh = mesh};
}

}  // namespace surfaces::hall_floor

namespace surfaces::hall_cloth {
namespace {

const std::vector<std::string> dyes{"red", "green", "blue"};

/// Metres: the height of the cloth's rail and of its lower edge, and its gathered width at the rail.
constexpr double rail = 3.55, edge = 1.15, width = 1.9;

/// The width of the cloth over that of its curtain, and the width of the map on it.
constexpr double fullness = 1.6, map_size = 1.5;

std::size_t dye_of(const SurfaceSettings& settings) {
  return static_cast<std::size_t>(std::ranges::find(dyes, settings.parameters.word("dye")) - dyes.begin());
}

struct Silk {
  explicit Silk(const SurfaceSettings& settings)
      : cloth(glm::ivec2{200}, {4, 3}, settings.seed), dye(dye_of(settings)) {}

  [[nodiscard]] glm::dvec3 normal(const glm::dvec2& uv) const { return Jacquard::normal(cloth.at(uv), 0.5); }
  [[nodiscard]] glm::dvec3 color(const glm::dvec2& uv) const {
    static constexpr std::array<glm::dvec3, 3> grounds{{{0.34, 0.015, 0.02}, {0.02, 0.16, 0.05}, {0.02, 0.05, 0.26}}};
    return silk_color(cloth.at(uv), grounds.at(dye), {0.40, 0.25, 0.07}, 0.35);
  }
  [[nodiscard]] double exponent(const glm::dvec2& uv) const { return silk_exponent(cloth.at(uv), 18.0, 120.0); }

  Jacquard cloth;
  std::size_t dye;
};

/// One curtain in its arch, seen from the nave; `side` -1 hangs on the left.
Mesh curtain(double side, int index, const PeriodicNoise& noise) {
  return grid_mesh(96, 48, [&](const glm::dvec2& st) {
    const HeightPoint at{st};
    const Height fall = 1.0 - at.y;
    const Height wander = noise.at(2.0 * at.x + 3.0 * index, 1.4 * fall + 4.0 * (side + 1.0));
    const Height wave = cos(2.0 * std::numbers::pi * (6.0 * at.x + 0.5 * wander));
    const Height depth = (0.03 + 0.06 * smooth_step(fall, 0.0, 0.7)) * wave;
    const Height across = (at.x - 0.5) * width * (1.0 + 0.08 * fall * fall);
    const BentPoint point{side * hall::arcade - side * depth, rail - (rail - edge) * fall + 0.03 * wander * fall,
                          hall::bay_middle(index) + side * across};
    return bent_vertex(point, glm::dvec2{fullness * width * st.x, (rail - edge) * (1.0 - st.y)} / map_size);
  });
}

Mesh mesh(const SurfaceSettings& settings) {
  const int dye = static_cast<int>(dye_of(settings)), count = static_cast<int>(dyes.size());
  std::mt19937_64 random(settings.seed);
  const PeriodicNoise noise(24, random);
  Mesh mesh;
  for (int i = 0; i < hall::bays; ++i) {
    if (i % count == dye) append(mesh, curtain(-1.0, i, noise));
    if ((i + 1) % count == dye) append(mesh, curtain(1.0, i, noise));
  }
  mesh.name = "curtains";
  return mesh;
}

}  // namespace

Surface surface() {
  return {.name = "hall_cloth",
          .summary = "figured curtains in the arches of a hall, one of three colours that take turns",
          .parameters = {word_option("dye", dyes, "colour of the ground, and whose turn it is")},
          .default_resolution = 1024,
          .normals = map_of<4, &Silk::normal>,
          .base_color = map_of<4, &Silk::color>,
          .lobe_parameter = map_of<1, &Silk::exponent>,
          .distribution = NormalDistribution::blinn_phong,
          .mesh = mesh};
}

}  // namespace surfaces::hall_cloth

}  // namespace footprint
