// tablecloth: a square cloth over a round table, with a creased weave made of noise.
#include <array>

#include "scenes/surfaces/height.hpp"
#include "scenes/surfaces/meshes.hpp"
#include "scenes/surfaces/texel_grid.hpp"

namespace footprint::surfaces::tablecloth {
namespace {

/// Metres. The cloth's corners hang down to 0.3 above the floor.
constexpr double half_side = 0.7, table_radius = 0.5, table_height = 0.74;

/// The cloth bends over the table's rim along a quarter of a circle.
constexpr double rim = 0.025;
constexpr double rim_length = rim * std::numbers::pi / 2.0;

/// The weave of the normal map: cells along its width, and slope.
constexpr std::array<Octave, 5> octaves{{{10, 0.04}, {27, 0.05}, {71, 0.08}, {170, 0.18}, {340, 0.3}}};

Image normals(const SurfaceSettings& settings) { return relief_normals(settings, octaves); }

/// The folds of the cloth around the table.
class Drape {
 public:
  explicit Drape(std::uint32_t seed) : random_(seed) {}

  /// The position of the cloth's point at `at`, metres from its middle: x to the right, y to the back.
  [[nodiscard]] BentPoint at(const HeightPoint& at) const {
    const Height radius = sqrt(at.x * at.x + at.y * at.y + 1e-18);
    if (radius.value() <= table_radius) return {at.x, Height{table_height}, -at.y};
    const Height length = radius - table_radius;
    Height out{table_radius + rim}, down = rim + length - rim_length;
    if (length.value() < rim_length) {
      out = table_radius + rim * sin(length / rim);
      down = rim - rim * cos(length / rim);
    }
    const Height folds = this->folds(at, radius) * smooth_step(length, 0.0, 0.3);
    out += (0.02 + 0.36 * length) * folds;
    down = down * (1.0 - 0.1 * folds);
    const Height drop = table_height - down;
    return {out * at.x / radius, drop, -1.0 * out * at.y / radius};
  }

 private:
  /// 0 in a hollow to 1 on a ridge: as many waves around the table as the cloth is too wide there.
  [[nodiscard]] Height folds(const HeightPoint& at, const Height& radius) const {
    constexpr double waves = 9.0;
    const Height angle = atan2(at.y, at.x);
    // The noise is looked up on a circle, so that it closes around the table.
    const Height wander = wander_.at(2.5 * at.x / radius, 2.5 * at.y / radius);
    const Height lesser = wander_.at(4.0 + 4.1 * at.x / radius, 4.1 * at.y / radius);
    const Height wave = 0.5 + 0.5 * cos(waves * angle + 3.5 * wander);
    return wave * (0.75 + 0.7 * lesser);
  }

  std::mt19937_64 random_;
  PeriodicNoise wander_{8, random_};
};

Mesh mesh(const SurfaceSettings& settings) {
  constexpr int cells = 260;
  const Drape drape(settings.seed);
  Mesh mesh = grid_mesh(cells, cells, [&](const glm::dvec2& st) {
    return bent_vertex(drape.at(HeightPoint{half_side * (2.0 * st - 1.0)}), {st.x, 1.0 - st.y});
  });
  mesh.name = "tablecloth";
  return mesh;
}

}  // namespace

Surface surface() {
  return {.name = "tablecloth",
          .summary = "a square cloth draped over a round table, creased by noise of five octaves",
          .parameters = {number_option("steepness", 1.0, 0, 10, "factor on the slopes of the creases")},
          .default_resolution = 1024,
          .normals = normals,
          .mesh = mesh};
}

}  // namespace footprint::surfaces::tablecloth
