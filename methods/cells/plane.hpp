// Normals as points of a plane, with weights.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/image/image.hpp"

namespace footprint::cells {

/// The plane of the moments.
enum class Coordinates { stereographic, slopes };

/// n_xy / (1 + n_z) of a unit normal: the stereographic projection from the pole below. It is conformal, and the
/// horizon has length 1. Normals below the horizon are moved onto it.
[[nodiscard]] inline glm::dvec2 stereographic_of(const glm::dvec3& normal) {
  const glm::dvec2 p = glm::dvec2(normal) / (1.0 + std::max(normal.z, 0.0));
  return normal.z < 0.0 ? p / std::max(glm::length(p), 1e-12) : p;
}

/// A normal of the map as a point; invalid normals have weight 0.
struct PlanePoint {
  glm::dvec2 at{0.0};
  double weight = 0.0;
};

/// The points of a normal map (RGBA: normal, weight), row by row. Slopes are limited to `steepest`.
[[nodiscard]] std::vector<PlanePoint> plane_points(const Image& normals, Coordinates coordinates, double steepest);

}  // namespace footprint::cells
