// Charts, UV islands: the pieces of a mesh over which texture coordinates are continuous.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/scene/scene.hpp"

namespace footprint {

/// The pieces that a mesh falls into.
struct Charts {
  std::vector<std::uint32_t> of_vertex;  ///< for each vertex its chart's number, below `count`
  std::uint32_t count = 0;
};

/// Triangles that share a vertex are of one chart; vertices at one position with the same texture coordinates are one
/// vertex, whatever their index, normal and tangent. Coordinates of a set that no map of `material` reads do not count.
[[nodiscard]] Charts charts_of(std::span<const Vertex> vertices, std::span<const std::uint32_t> indices,
                               const Material& material);

}  // namespace footprint
