// See hemisphere_grid.hpp.
#include "renderer/ndf/hemisphere_grid.hpp"

#include <algorithm>
#include <cmath>

namespace footprint {
namespace {

// The part of a square cell that is inside of the unit disc, and the centre of that part.
struct Part {
  double share = 0.0;
  glm::dvec2 centre{0.0};
};

Part part_inside(const glm::dvec2& centre, double side) {
  constexpr int steps = 32;
  const glm::dvec2 far = glm::abs(centre) + 0.5 * side;
  if (glm::dot(far, far) <= 1.0) return {1.0, centre};
  const glm::dvec2 near = glm::max(glm::abs(centre) - 0.5 * side, 0.0);
  if (glm::dot(near, near) >= 1.0) return {};
  int inside = 0;
  glm::dvec2 sum(0.0);
  for (int y = 0; y < steps; ++y) {
    for (int x = 0; x < steps; ++x) {
      const glm::dvec2 p = centre + side * ((glm::dvec2(x, y) + 0.5) / static_cast<double>(steps) - 0.5);
      if (glm::dot(p, p) >= 1.0) continue;
      ++inside;
      sum += p;
    }
  }
  if (inside == 0) return {};
  return {static_cast<double>(inside) / (steps * steps), sum / static_cast<double>(inside)};
}

glm::vec3 direction_of(const glm::dvec2& p) {
  const double r2 = glm::dot(p, p);
  return {p * std::sqrt(std::max(2.0 - r2, 0.0)), std::max(1.0 - r2, 0.0)};
}

}  // namespace

HemisphereGrid hemisphere_grid(int resolution) {
  HemisphereGrid grid{resolution, {}, {}};
  const double side = 2.0 / resolution;
  for (int y = 0; y < resolution; ++y) {
    for (int x = 0; x < resolution; ++x) {
      const Part part = part_inside((glm::dvec2(x, y) + 0.5) * side - 1.0, side);
      if (part.share <= 0.0) continue;
      grid.directions.push_back(direction_of(part.centre));
      grid.solid_angles.push_back(2.0 * side * side * part.share);  // d(omega) = 2 dX dY
    }
  }
  return grid;
}

int resolution_for(const BaseLobe& narrowest) {
  // A Gaussian's square at a spacing of 0.85 of its own deviation: exp(-2 pi^2 / (2 * 0.85^2)) = 1e-6. A GGX lobe's
  // core has the transform of an exponential, which takes a finer grid.
  const double spacing = lobe_width(narrowest) * (narrowest.distribution == NormalDistribution::ggx ? 0.5 : 0.85);
  constexpr double least = 64.0;
  constexpr double largest_distance_between_neighbours = 4.0;  // times 1 / resolution
  return static_cast<int>(std::ceil(
      std::clamp(largest_distance_between_neighbours / spacing, least, static_cast<double>(largest_resolution))));
}

std::vector<glm::vec3> disc_directions(int size) {
  std::vector<glm::vec3> directions;
  directions.reserve(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) {
      const double x = 2.0 * (column + 0.5) / size - 1.0;
      const double y = 1.0 - 2.0 * (row + 0.5) / size;
      const double z2 = 1.0 - x * x - y * y;
      directions.push_back(z2 > 0.0 ? glm::vec3(x, y, std::sqrt(z2)) : glm::vec3(0.0F));
    }
  }
  return directions;
}

}  // namespace footprint
