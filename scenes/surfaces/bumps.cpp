// bumps: round bumps of random position, width and height, close together, with smooth valleys between them.
#include <cmath>

#include "renderer/core/numbers.hpp"
#include "scenes/surfaces/meshes.hpp"
#include "scenes/surfaces/texel_grid.hpp"

namespace footprint::surfaces::bumps {
namespace {

/// A bump of height top - sharpness r^2. Lengths along the map are in cells; heights are those of steepness 1.
struct Bump {
  glm::dvec2 centre;  ///< from its cell's lower left corner
  double top = 0.0, sharpness = 0.0;
};

using Bumps = WrappedGrid<Bump>;

/// Sharpness of the valleys: the height field is log(sum exp(blend h)) / blend, a rounded maximum.
constexpr double blend = 10.0;

/// Bumps this many cells away count. Those beyond are 2.2 cells or more away and, at `blend`, less than 1e-7 of the
/// sum.
constexpr int reach = 2;

/// One bump per cell of a count x count grid, within 0.3 of the cell's centre.
Bumps scatter(int count, std::uint32_t seed) {
  std::mt19937_64 random(seed);
  Bumps bumps(count, count);
  for (Bump& bump : bumps) {
    const double x = uniform(random), y = uniform(random);
    bump.centre = 0.5 + 0.6 * (glm::dvec2{x, y} - 0.5);
    bump.top = 0.2 * uniform(random);
    bump.sharpness = 0.7 + 0.6 * uniform(random);
  }
  return bumps;
}

/// The slope at `point`, in cells, for steepness 1: the bumps' slopes weighted by exp(blend h).
glm::dvec2 slope_at(const Bumps& bumps, const glm::dvec2& point) {
  glm::dvec2 sum{0.0};
  double weights = 0.0;
  const int column = static_cast<int>(point.x), row = static_cast<int>(point.y);
  for (int y = row - reach; y <= row + reach; ++y) {
    for (int x = column - reach; x <= column + reach; ++x) {
      const Bump& bump = bumps.at(x, y);
      const glm::dvec2 offset = point - glm::dvec2{x, y} - bump.centre;
      const double weight = std::exp(blend * (bump.top - bump.sharpness * glm::dot(offset, offset)));
      sum -= 2.0 * weight * bump.sharpness * offset;
      weights += weight;
    }
  }
  return sum / weights;
}

Image normals(const SurfaceSettings& settings) {
  const int count = static_cast<int>(settings.parameters.number("count"));
  const double steepness = settings.parameters.number("steepness");
  const Bumps bumps = scatter(count, settings.seed);
  return fill_normals(settings.resolution, [&](const glm::dvec2& uv) {
    return normal_of_slope(steepness * slope_at(bumps, uv * static_cast<double>(count)));
  });
}

}  // namespace

Surface surface() {
  return {.name = "bumps",
          .summary = "round bumps of random place, width and height, close together",
          .parameters = {whole_option("count", 16, 1, 1024, "bumps along a side"),
                         number_option("steepness", 0.7, 0, 10,
                                       "slope half a cell away from the middle of a mean bump, rise over run")},
          .normals = normals,
          .mesh = square_mesh};
}

}  // namespace footprint::surfaces::bumps
