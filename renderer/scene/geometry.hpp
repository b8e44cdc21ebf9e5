// Meshes: triangles of a material, tangents, joining, splitting of edges, and planes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/scene/material.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {

/// How indices make triangles (glTF 2.0, section 3.7.2.1).
enum class Topology { triangles, strip, fan };

/// A strip or a fan as a triangle list with the winding of glTF 2.0; a trailing incomplete triangle is left out.
[[nodiscard]] std::vector<std::uint32_t> triangle_list(std::span<const std::uint32_t> indices, Topology topology);

/// Triangles over vertices of their own.
struct TriangleSoup {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;  ///< three a triangle
};

/// All triangles of a material, mesh after mesh.
[[nodiscard]] TriangleSoup triangles_of(const Scene& scene, std::size_t material);

/// Drops the vertices that no index uses and renumbers the rest, in order of first use.
void drop_unused_vertices(std::vector<Vertex>& vertices, std::vector<std::uint32_t>& indices);

/// Adds the triangles of `part` to `mesh`, whatever its material.
void append(Mesh& mesh, const Mesh& part);

/// Gives each triangle its own three vertices with the triangle's normal (glTF 2.0: normals that are not given are
/// flat). A degenerate triangle gets +z.
void make_flat_normals(std::vector<Vertex>& vertices, std::vector<std::uint32_t>& indices);

/// Brings every normal to unit length. One of zero length or with a NaN is replaced by the area-weighted mean of its
/// triangles' normals (+z where these are degenerate too). Returns how many were replaced.
std::size_t repair_normals(std::span<Vertex> vertices, std::span<const std::uint32_t> indices);

/// Makes the tangents that a file gives orthonormal to the normals; one that is not finite or parallel to its normal
/// is replaced by any that fits. Returns how many were replaced. Normals must be unit.
std::size_t repair_tangents(std::span<Vertex> vertices);

/// Computes tangents from positions, unit normals and the texture coordinates that `coordinates` gives: the triangles'
/// d position / d u, projected on the vertex's tangent plane, weighted by the angle at the vertex (Mikkelsen 2008).
/// The bitangent cross(normal, tangent) * w points against v, to the top of the map, as glTF's green channel wants.
/// A vertex shared by triangles of opposite handedness is split; one whose triangles all have degenerate coordinates
/// gets any frame around its normal.
void compute_tangents(std::vector<Vertex>& vertices, std::vector<std::uint32_t>& indices,
                      const TextureCoordinates& coordinates);

/// A rectangle of `size` (metres) in the xy plane, centred on the origin: normal +z, tangent +x, four vertices, two
/// triangles, material 0. Texture coordinates run from (0, 0) at the top left to `uv_tiling` at the bottom right (glTF:
/// v points down), in both sets.
[[nodiscard]] Mesh make_plane(glm::vec2 size, glm::vec2 uv_tiling);

}  // namespace footprint
