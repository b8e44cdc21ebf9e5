// For tests: how often the triangles of a mesh cover the square of texture coordinates.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "renderer/scene/scene.hpp"

namespace footprint::testing {

/// For each cell of a grid of `side` x `side` over the unit square, row by row: the triangles around its
/// centre, edges not counted.
[[nodiscard]] inline std::vector<int> texture_coverage(const Mesh& mesh, int side) {
  std::vector<int> counts(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 0);
  const auto turn = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; };
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    std::array<glm::dvec2, 3> corners{};
    for (std::size_t c = 0; c < 3; ++c) {
      corners.at(c) = static_cast<double>(side) * glm::dvec2(mesh.vertices[mesh.indices[i + c]].uv0);
    }
    const double area = turn(corners[1] - corners[0], corners[2] - corners[0]);
    const glm::ivec2 low = glm::ivec2(glm::min(glm::min(corners[0], corners[1]), corners[2]));
    const glm::ivec2 high = glm::ivec2(glm::max(glm::max(corners[0], corners[1]), corners[2]));
    for (int y = std::max(low.y, 0); y <= std::min(high.y, side - 1); ++y) {
      for (int x = std::max(low.x, 0); x <= std::min(high.x, side - 1); ++x) {
        const auto is_within = [&](std::size_t c) {
          const glm::dvec2 &from = corners.at(c), &to = corners.at((c + 1) % 3);
          return turn(to - from, glm::dvec2{x + 0.5, y + 0.5} - from) / area > 1e-4;
        };
        if (is_within(0) && is_within(1) && is_within(2)) ++counts[static_cast<std::size_t>(y * side + x)];
      }
    }
  }
  return counts;
}

}  // namespace footprint::testing
