// scales: hemispheres in staggered rows on a flat ground. A hemisphere seen from above has every normal, its x and y
// evenly over the unit disc; the ground between them is a spike at the pole.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/core/random.hpp"
#include "scenes/surfaces/meshes.hpp"
#include "scenes/surfaces/texel_grid.hpp"
#include "scenes/surfaces/wrapped_grid.hpp"

namespace footprint {
namespace {

struct Scale {
  glm::dvec2 offset;  ///< from its place in the lattice
  double radius = 0.0;
};

/// Rows of scales, each odd row moved by half a column. Lengths are in map widths.
class Lattice {
 public:
  /// The number of rows is even, so that the map tiles, and makes the lattice as nearly hexagonal as it can be.
  Lattice(int columns, double fill, double variation, std::uint32_t seed)
      : scales_(columns, 2 * std::max(1, static_cast<int>(std::lround(columns / std::numbers::sqrt3)))) {
    const double across = 1.0 / scales_.columns(), up = 1.0 / scales_.rows();
    const double room = 0.5 * std::min({across, std::hypot(0.5 * across, up), 2.0 * up});  // radius of touching discs
    std::mt19937_64 random(seed);
    for (Scale& scale : scales_) {
      scale.radius = fill * room * (1.0 - variation * uniform(random));
      const double angle = 2.0 * std::numbers::pi * uniform(random);
      scale.offset = (room - scale.radius) * uniform(random) * glm::dvec2{std::cos(angle), std::sin(angle)};
    }
  }

  /// From the centre of the scale that covers `place`, as a share of its radius; zero on the ground.
  [[nodiscard]] glm::dvec2 offset_at(const glm::dvec2& place) const {
    const int row = static_cast<int>(place.y * scales_.rows()), column = static_cast<int>(place.x * scales_.columns());
    for (int y = row - 1; y <= row + 1; ++y) {
      for (int x = column - 1; x <= column + 1; ++x) {
        const Scale& scale = scales_.at(x, y);
        const double shift = y % 2 == 0 ? 0.25 : 0.75;  // of a column
        const glm::dvec2 centre{(x + shift) / scales_.columns(), (y + 0.5) / scales_.rows()};
        const glm::dvec2 offset = (place - centre - scale.offset) / scale.radius;
        if (glm::dot(offset, offset) < 1.0) return offset;
      }
    }
    return glm::dvec2{0.0};
  }

 private:
  WrappedGrid<Scale> scales_;
};

Image normals(const SurfaceSettings& settings) {
  const Options& parameters = settings.parameters;
  const Lattice lattice(static_cast<int>(parameters.number("count")), parameters.number("fill"),
                        parameters.number("variation"), settings.seed);
  const double edge = std::sin(glm::radians(parameters.number("edge_degrees")));
  return fill_normals(settings.resolution, [&](const glm::dvec2& place) {
    const glm::dvec2 tilt = edge * lattice.offset_at(place);
    return glm::dvec3{tilt, std::sqrt(1.0 - glm::dot(tilt, tilt))};
  });
}

}  // namespace

Surface scales_surface() {
  return {.name = "scales",
          .summary = "hemispheres in staggered rows on a flat ground",
          .parameters = {{.name = "count",
                          .default_value = 8.0,
                          .minimum = 1,
                          .maximum = 1024,
                          .meaning = "scales along the map's width",
                          .integer = true},
                         {.name = "fill",
                          .default_value = 0.95,
                          .minimum = 0.1,
                          .maximum = 1,
                          .meaning = "radius of the largest scale as a share of that of touching ones"},
                         {.name = "variation",
                          .default_value = 0.2,
                          .minimum = 0,
                          .maximum = 0.9,
                          .meaning = "how much smaller than the largest the smallest scale is, as a share of it"},
                         {.name = "edge_degrees",
                          .default_value = 90.0,
                          .minimum = 0,
                          .maximum = 90,
                          .meaning = "tilt at a scale's edge, degrees; 90: hemispheres"}},
          .normals = normals,
          .mesh = square_mesh};
}

}  // namespace footprint
