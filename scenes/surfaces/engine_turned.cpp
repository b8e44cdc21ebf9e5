// engine_turned: metal under a polishing rod that was set down in rows: overlapping discs of fine, concentric
// scratches.
#include <array>
#include <cmath>

#include "renderer/core/numbers.hpp"
#include "scenes/surfaces/meshes.hpp"
#include "scenes/surfaces/texel_grid.hpp"

namespace footprint::surfaces::engine_turned {
namespace {

/// Lengths on the map are in distances between discs; a disc has this radius.
constexpr double disc_radius = 0.74;

/// The scratches of one disc, from its middle outwards.
struct Disc {
  std::array<double, 64> ends{};    ///< radius at which each scratch ends, ascending
  std::array<double, 64> slopes{};  ///< of its flanks
};

Disc draw_disc(int scratches, double tilt, std::mt19937_64& random) {
  Disc disc;
  double end = 0.0;
  for (int i = 0; i < scratches; ++i) {
    const auto at = static_cast<std::size_t>(i);
    end += 0.6 + 0.8 * uniform(random);
    disc.ends[at] = end;
    disc.slopes[at] = tilt * (0.4 + 0.6 * uniform(random));
  }
  for (double& x : disc.ends) x *= disc_radius / end;
  return disc;
}

/// The discs in their rows. Each covers its neighbours to the left and below, so that the map tiles.
class EngineTurning {
 public:
  explicit EngineTurning(const SurfaceSettings& settings)
      : scratches_(static_cast<std::size_t>(settings.parameters.number("scratches"))),
        discs_(static_cast<int>(settings.parameters.number("count")),
               static_cast<int>(settings.parameters.number("count"))) {
    std::mt19937_64 random(settings.seed);
    const double tilt = std::tan(glm::radians(settings.parameters.number("tilt_degrees")));
    for (Disc& disc : discs_) disc = draw_disc(static_cast<int>(scratches_), tilt, random);
  }

  [[nodiscard]] glm::dvec3 normal(const glm::dvec2& uv) const {
    const glm::dvec2 at = static_cast<double>(discs_.columns()) * uv;
    const int column = static_cast<int>(std::floor(at.x)), row = static_cast<int>(std::floor(at.y));
    // From the top disc that can reach the point to the bottom one, which is in the point's square and always does.
    for (int y = row + 1; y >= row - 1; --y) {
      for (int x = column + 1; x >= column - 1; --x) {
        const glm::dvec2 offset = at - (glm::dvec2(x, y) + 0.5);
        if (glm::dot(offset, offset) < disc_radius * disc_radius) return normal_on(discs_.at(x, y), offset);
      }
    }
    return {0.0, 0.0, 1.0};
  }

 private:
  /// Scratches are V-shaped: each has an inner flank, which faces outwards, and an outer one.
  [[nodiscard]] glm::dvec3 normal_on(const Disc& disc, const glm::dvec2& offset) const {
    const double radius = glm::length(offset);
    std::size_t scratch = 0;
    while (scratch + 1 < scratches_ && disc.ends[scratch] < radius) ++scratch;
    const double start = scratch == 0 ? 0.0 : disc.ends[scratch - 1];
    const double side = 2.0 * radius < start + disc.ends[scratch] ? -1.0 : 1.0;
    return normal_of_slope(side * disc.slopes[scratch] * offset / std::max(radius, 1e-9));
  }

  std::size_t scratches_;
  WrappedGrid<Disc> discs_;
};

}  // namespace

Surface surface() {
  return {.name = "engine_turned",
          .summary = "rows of overlapping discs of concentric V-shaped scratches",
          .parameters = {whole_option("count", 24, 1, 1024, "discs along the map's width, and as many rows"),
                         whole_option("scratches", 14, 1, 64, "scratches of a disc"),
                         number_option("tilt_degrees", 16.0, 0, 80, "tilt of the steepest scratch's flanks, degrees")},
          .default_resolution = 2048,
          .normals = map_of<4, &EngineTurning::normal>,
          .mesh = square_mesh};
}

}  // namespace footprint::surfaces::engine_turned
