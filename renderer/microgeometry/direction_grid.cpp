// Implements the concentric map, its inverse, and bilinear weights.
#include "renderer/microgeometry/direction_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace footprint {

using std::numbers::pi;

glm::dvec3 square_to_hemisphere(const glm::dvec2& point) {
  const glm::dvec2 p = 2.0 * point - 1.0;
  if (p.x == 0.0 && p.y == 0.0) return {0.0, 0.0, 1.0};
  const bool wide = std::abs(p.x) > std::abs(p.y);
  const double radius = wide ? p.x : p.y;  // signed: the angle is that of the sector's axis, or half a turn from it
  const double angle = wide ? pi / 4.0 * (p.y / p.x) : pi / 2.0 - pi / 4.0 * (p.x / p.y);
  const double sine = radius * std::sqrt(std::max(2.0 - radius * radius, 0.0));  // 1 - z^2 for z = 1 - radius^2
  return {sine * std::cos(angle), sine * std::sin(angle), 1.0 - radius * radius};
}

glm::dvec2 hemisphere_to_square(const glm::dvec3& direction) {
  const double sine2 = direction.x * direction.x + direction.y * direction.y;
  if (sine2 == 0.0) return {0.5, 0.5};
  // radius^2 = 1 - z, without the cancellation near the pole.
  const double radius = direction.z > 0.0 ? std::sqrt(sine2 / (1.0 + direction.z)) : 1.0;
  const bool wide = std::abs(direction.x) > std::abs(direction.y);
  const double lead = std::copysign(std::min(radius, 1.0), wide ? direction.x : direction.y);
  const double ratio = wide ? direction.y / direction.x : direction.x / direction.y;
  const double other = lead * std::atan(ratio) * (4.0 / pi);
  return 0.5 * (wide ? glm::dvec2(lead, other) : glm::dvec2(other, lead)) + 0.5;
}

std::vector<glm::dvec3> direction_grid(int side) {
  std::vector<glm::dvec3> directions;
  directions.reserve(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) directions.push_back(square_to_hemisphere({(x + 0.5) / side, (y + 0.5) / side}));
  }
  return directions;
}

GridCells cells_around(const glm::dvec3& direction, int side) {
  const double last = side - 1.0;
  const glm::dvec2 cell = glm::clamp(hemisphere_to_square(direction) * static_cast<double>(side) - 0.5, 0.0, last);
  const glm::dvec2 low = glm::min(glm::floor(cell), last - 1.0);
  const glm::dvec2 part = cell - low;
  const auto row = static_cast<std::size_t>(side);
  const std::size_t first = static_cast<std::size_t>(low.y) * row + static_cast<std::size_t>(low.x);
  return {{first, first + 1, first + row, first + row + 1},
          {(1.0 - part.x) * (1.0 - part.y), part.x * (1.0 - part.y), (1.0 - part.x) * part.y, part.x * part.y}};
}

}  // namespace footprint
