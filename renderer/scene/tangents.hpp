// Tangents of vertices: computed as MikkTSpace defines them, repaired, and turned with the texels of a map.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/scene/material.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {

/// Makes a file's tangents orthonormal to its unit normals. A tangent that is not finite, or parallel to the normal, is
/// replaced by an arbitrary one. Returns the number of replaced tangents.
std::size_t repair_tangents(std::span<Vertex> vertices);

/// Computes tangents by the algorithm of MikkTSpace (Mikkelsen 2008), which glTF 2.0 prescribes. Vertices with equal
/// position, normal and texture coordinates count as one, so indexed and unindexed triangles get equal tangents. Around
/// such a vertex, triangles that meet in edges and have one handedness share a tangent: their d position / d u,
/// projected onto the plane of the normal and weighted by the angle of the projected corner.
/// The bitangent cross(normal, tangent) * w points against v, to the top of the map, as glTF requires. A vertex that
/// needs several tangents is split. Degenerate coordinates give an arbitrary tangent perpendicular to the normal.
/// vertices: normals of any length; one of length 0 does not restrict its tangent.
/// coordinates: of the map whose texels the tangents follow.
void compute_tangents(std::vector<Vertex>& vertices, std::vector<std::uint32_t>& indices,
                      const TextureCoordinates& coordinates);

/// Turns the tangents of a file about their normals as far as the transform of `coordinates` turns the texels on the
/// surface, and mirrors the frames where it mirrors them. The tangents must follow the set of `coordinates` without its
/// transform. A transform that only scales by positive factors and shifts changes nothing.
void turn_tangents(std::vector<Vertex>& vertices, const std::vector<std::uint32_t>& indices,
                   const TextureCoordinates& coordinates);

}  // namespace footprint
