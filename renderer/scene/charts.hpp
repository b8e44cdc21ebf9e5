// UV islands of a mesh, and new texture coordinates that show each point of the surface once.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/scene/scene.hpp"

namespace footprint {

/// The charts (UV islands) of a mesh.
struct Charts {
  std::vector<std::uint32_t> of_vertex;  ///< the number of each vertex's chart, below `count`
  std::uint32_t count = 0;
};

/// Triangles that share a vertex are in one chart. Vertices with equal positions and texture coordinates count as one.
/// material: its maps decide which sets of coordinates count.
[[nodiscard]] Charts charts_of(std::span<const Vertex> vertices, std::span<const std::uint32_t> indices,
                               const Material& material);

/// Replaces both sets of texture coordinates so that every triangle has its own part of the unit square, all at one
/// scale. A chart is a connected piece that does not overlap along its axis and leans away from it by at most 60
/// degrees, so lengths shrink to at least a half. Charts are oriented with +y up (-z if level) and packed with gaps of
/// 1/1024. Vertices between charts are split and tangents are computed; positions, normals, and the triangles' order
/// and winding stay. Triangles without area are at (0, 0). Positions must be finite.
void unwrap(Mesh& mesh);

}  // namespace footprint
