// The measures of the hall that hall_stone, hall_floor and hall_cloth are the stone, the floor and the cloth of: a nave
// between two rows of columns with arches, an aisle on either side. y is up, the nave runs from z = 0 to -z.
#pragma once

#include <glm/glm.hpp>

#include "renderer/scene/surface.hpp"

namespace footprint::hall {

// Metres.
inline constexpr int bays = 6;
inline constexpr double bay = 3.0, length = bay * bays;
inline constexpr double arcade = 2.6;                      ///< from the nave's middle line to the columns' axes
inline constexpr double arcade_half_thickness = 0.28;      ///< of the wall over the columns
inline constexpr double outer_wall = 5.2;                  ///< from the middle line
inline constexpr double spring = 3.7, arch_radius = 1.12;  ///< where arches begin, and their radius
inline constexpr double aisle_ceiling = 5.6, vault_spring = 6.6;

/// The middle of a bay, 0 the nearest.
[[nodiscard]] constexpr double bay_middle(int index) { return -bay * (index + 0.5); }

/// A plane of the hall: where (0, 0) lies on it, and which way right and up are for whoever looks at it.
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

}  // namespace footprint::hall
