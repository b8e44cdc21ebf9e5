// UV islands of a mesh, and new texture coordinates that show each point of the surface once.
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

/// Gives every triangle its own part of the unit square, in both sets of texture coordinates, all at one scale.
/// A chart is a connected piece whose triangles lean away from its axis by 60 degrees at most (so that lengths
/// shrink to a half at most) and do not overlap seen along it; its upper side is towards +y, or -z where it lies level.
/// Charts are packed with a gap of 1/1024 of the square around each. Vertices on a border between charts are split,
/// tangents computed; positions and normals stay, so do the triangles' order and winding. Triangles without area lie at
/// (0, 0). Positions must be finite.
void unwrap(Mesh& mesh);

}  // namespace footprint
