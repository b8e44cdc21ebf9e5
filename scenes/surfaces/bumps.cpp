// bumps: rounded bumps of random place, width and height, close together; slopes spread evenly around flat.
#include <cmath>

#include "renderer/core/random.hpp"
#include "scenes/surfaces/meshes.hpp"
#include "scenes/surfaces/texel_grid.hpp"

namespace footprint {
namespace {

/// A bump a (1 - r^2 / R^2)^3 within its radius R.
struct Bump {
  glm::dvec2 centre;
  double radius = 0.0, height = 0.0;
};

/// The largest slope of (1 - t^2)^3 over t, at t = 1 / sqrt(5).
const double steepest = 6.0 / std::sqrt(5.0) * (16.0 / 25.0);

/// One bump a cell of a count x count grid, row by row. Lengths are in cells; a bump reaches 0.95 cells from its
/// centre, which lies within 0.35 of its cell's: no point is reached from further than the next cell.
std::vector<Bump> scatter(int count, double steepness, std::uint32_t seed) {
  std::mt19937_64 random(seed);
  std::vector<Bump> bumps(static_cast<std::size_t>(count) * static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < bumps.size(); ++i) {
    const auto cells = static_cast<std::size_t>(count);
    const glm::dvec2 cell{static_cast<double>(i % cells), static_cast<double>(i / cells)};
    const double x = uniform(random), y = uniform(random), width = uniform(random), slope = uniform(random);
    Bump& bump = bumps[i];
    bump.centre = cell + 0.5 + 0.7 * (glm::dvec2{x, y} - 0.5);
    bump.radius = 0.6 + 0.35 * width;
    bump.height = steepness * (0.5 + 0.5 * slope) * bump.radius / steepest;
  }
  return bumps;
}

/// The sum of the bumps' slopes at `place`, in cells.
glm::dvec2 slope_at(const std::vector<Bump>& bumps, int count, const glm::dvec2& place) {
  glm::dvec2 sum{0.0};
  const int column = static_cast<int>(place.x), row = static_cast<int>(place.y);
  for (int y = row - 1; y <= row + 1; ++y) {
    for (int x = column - 1; x <= column + 1; ++x) {
      const int wrapped_x = (x + count) % count, wrapped_y = (y + count) % count;
      const Bump& bump = bumps[static_cast<std::size_t>(wrapped_y * count + wrapped_x)];
      const glm::dvec2 offset = place - bump.centre - glm::dvec2{x - wrapped_x, y - wrapped_y};
      const double inside = 1.0 - glm::dot(offset, offset) / (bump.radius * bump.radius);
      if (inside > 0.0) sum -= 6.0 * bump.height / (bump.radius * bump.radius) * inside * inside * offset;
    }
  }
  return sum;
}

Image normals(const SurfaceSettings& settings) {
  const int count = static_cast<int>(settings.parameters.number("count"));
  const std::vector<Bump> bumps = scatter(count, settings.parameters.number("steepness"), settings.seed);
  return fill_normals(settings.resolution, [&](const glm::dvec2& place) {
    return normal_of_slope(slope_at(bumps, count, place * static_cast<double>(count)));
  });
}

}  // namespace

Surface bumps_surface() {
  return {.name = "bumps",
          .summary = "rounded bumps of random place, width and height, close together",
          .parameters = {{.name = "count",
                          .default_value = 16.0,
                          .minimum = 1,
                          .maximum = 1024,
                          .meaning = "bumps along a side",
                          .integer = true},
                         {.name = "steepness",
                          .default_value = 0.7,
                          .minimum = 0,
                          .maximum = 10,
                          .meaning = "steepest slope of the highest bump on its own, rise over run"}},
          .normals = normals,
          .mesh = square_mesh};
}

}  // namespace footprint
