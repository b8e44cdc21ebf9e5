// For tests: the area of a mesh.
#pragma once

#include <cstddef>

#include "renderer/scene/scene.hpp"

namespace footprint::testing {

/// The sum over its triangles, square metres.
[[nodiscard]] inline double mesh_area(const Mesh& mesh) {
  double sum = 0.0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const glm::dvec3 a = mesh.vertices[mesh.indices[i]].position, b = mesh.vertices[mesh.indices[i + 1]].position,
                     c = mesh.vertices[mesh.indices[i + 2]].position;
    sum += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  return sum;
}

}  // namespace footprint::testing
