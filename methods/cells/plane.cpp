// Projects normals by either map of directions to a plane.
#include "methods/cells/plane.hpp"

#include "renderer/bake/slope_moments.hpp"

namespace footprint::cells {

std::vector<PlanePoint> plane_points(const Image& normals, Coordinates coordinates, double steepest) {
  std::vector<PlanePoint> points(normals.texel_count());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float* const n = &normals.texels[4 * i];
    const glm::dvec3 normal(n[0], n[1], n[2]);
    if (n[3] <= 0.0F || glm::length(normal) < 1e-3) continue;
    const glm::dvec3 unit = glm::normalize(normal);
    points[i] = {.at = coordinates == Coordinates::slopes ? slope_of(unit, steepest) : stereographic_of(unit),
                 .weight = n[3]};
  }
  return points;
}

}  // namespace footprint::cells
