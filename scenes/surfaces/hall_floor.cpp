// hall_floor: the floor of a hall, of polished and honed marble squares with inlaid lozenges, each laid a little askew.
#include <array>
#include <cmath>

#include "renderer/core/random.hpp"
#include "scenes/surfaces/hall.hpp"
#include "scenes/surfaces/meshes.hpp"
#include "scenes/surfaces/octaves.hpp"
#include "scenes/surfaces/texel_grid.hpp"
#include "scenes/surfaces/wrapped_grid.hpp"

namespace footprint::surfaces::hall_floor {
namespace {

/// The map covers so many metres, of so many squares each way; an even number, so that they alternate.
constexpr double map_size = 3.0;
constexpr int squares = 8;

/// Half the width of a joint, in squares.
constexpr double joint = 0.012;

constexpr std::array<Octave, 3> waviness{{{20, 0.006}, {80, 0.012}, {330, 0.02}}};
constexpr std::array<Octave, 4> veins{{{4, 1.0}, {11, 0.5}, {31, 0.25}, {90, 0.12}}};

enum class Stone { black, white, red, cement };

/// What lies at a point, and how its square is tilted.
struct Slab {
  Stone stone;
  glm::dvec2 slope;
};

class Paving {
 public:
  Paving(std::uint32_t seed, double tilt) : Paving(std::mt19937_64(seed), tilt) {}

  [[nodiscard]] Slab at(const glm::dvec2& uv) const {
    const glm::dvec2 cell = static_cast<double>(squares) * uv;
    const int column = static_cast<int>(std::floor(cell.x)), row = static_cast<int>(std::floor(cell.y));
    const glm::dvec2 offset = glm::abs(cell - glm::dvec2(column, row) - 0.5);  // from the middle
    const double out = std::max(offset.x, offset.y), lozenge = offset.x + offset.y;
    const bool dark = wrap(column + row, 2) == 0;
    Slab slab{dark ? Stone::black : Stone::white, slopes_.at(column, row)};
    if (dark && lozenge < 0.34) slab.stone = Stone::red;
    if (out > 0.5 - joint || (dark && std::abs(lozenge - 0.34) < joint)) slab = {Stone::cement, glm::dvec2{0.0}};
    return slab;
  }

  [[nodiscard]] glm::dvec2 waves(const glm::dvec2& uv) const { return slope_of(waviness_.relief(HeightPoint{uv})); }

  /// 0 between the veins, to 1 along them.
  [[nodiscard]] double vein(const glm::dvec2& uv) const {
    return std::pow(1.0 - std::min(1.0, 4.0 * std::abs(veins_.value(uv))), 3.0);
  }

 private:
  Paving(std::mt19937_64 random, double tilt)
      : waviness_(waviness, random), veins_(veins, random), slopes_(squares, squares) {
    for (glm::dvec2& slope : slopes_) slope = tilt * (2.0 * glm::dvec2{uniform(random), uniform(random)} - 1.0);
  }

  OctaveNoise waviness_, veins_;
  WrappedGrid<glm::dvec2> slopes_;
};

Paving paving(const SurfaceSettings& settings) {
  return {settings.seed, std::tan(glm::radians(settings.parameters.number("tilt_degrees")))};
}

Image normals(const SurfaceSettings& settings) {
  const Paving floor = paving(settings);
  return fill_normals(settings.resolution,
                      [&](const glm::dvec2& uv) { return normal_of_slope(floor.at(uv).slope + floor.waves(uv)); });
}

Image base_color(const SurfaceSettings& settings) {
  const Paving floor = paving(settings);
  return fill_colors(glm::ivec2{settings.resolution}, [&](const glm::dvec2& uv) {
    static constexpr std::array<glm::dvec3, 4> colors{
        {{0.025, 0.027, 0.03}, {0.62, 0.58, 0.50}, {0.30, 0.055, 0.035}, {0.30, 0.28, 0.25}}};
    static constexpr std::array<glm::dvec3, 4> vein_colors{
        {{0.30, 0.30, 0.28}, {0.34, 0.32, 0.30}, {0.55, 0.33, 0.28}, {0.30, 0.28, 0.25}}};
    const auto stone = static_cast<std::size_t>(floor.at(uv).stone);
    return glm::mix(colors.at(stone), vein_colors.at(stone), floor.vein(uv));
  });
}

Image exponents(const SurfaceSettings& settings) {
  const Paving floor = paving(settings);
  return fill_values(glm::ivec2{settings.resolution}, [&](const glm::dvec2& uv) {
    static constexpr std::array<double, 4> polish{900.0, 70.0, 300.0, 5.0};
    return polish.at(static_cast<std::size_t>(floor.at(uv).stone));
  });
}

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
          .normals = normals,
          .base_color = base_color,
          .lobe_parameter = exponents,
          .distribution = NormalDistribution::blinn_phong,
          .mesh = mesh};
}

}  // namespace footprint::surfaces::hall_floor
