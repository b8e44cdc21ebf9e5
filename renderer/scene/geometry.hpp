// Meshes: triangles of a material, normals, joining, splitting of edges, and planes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/scene/scene.hpp"

namespace footprint {

/// `vector` at length 1, of any length that a double has; `fallback` if it has none or is not finite.
[[nodiscard]] glm::dvec3 unit_or(const glm::dvec3& vector, const glm::dvec3& fallback);

/// How indices form triangles (glTF 2.0, section 3.7.2.1).
enum class Topology { triangles, strip, fan };

/// A strip or a fan as a triangle list with the winding of glTF 2.0; a trailing incomplete triangle is left out.
[[nodiscard]] std::vector<std::uint32_t> triangle_list(std::span<const std::uint32_t> indices, Topology topology);

/// Triangles over vertices of their own.
struct TriangleSoup {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;  ///< three per triangle
};

/// All triangles of a material, mesh by mesh.
[[nodiscard]] TriangleSoup collect_triangles(const Scene& scene, std::size_t material);

/// Removes unused vertices and renumbers the others in order of first use.
void drop_unused_vertices(std::vector<Vertex>& vertices, std::vector<std::uint32_t>& indices);

/// Adds the triangles of `part` to `mesh`, of any material.
void append(Mesh& mesh, const Mesh& part);

/// Gives each triangle its own three vertices with the triangle's normal, for files without normals (glTF 2.0). A
/// degenerate triangle gets +z.
void make_flat_normals(std::vector<Vertex>& vertices, std::vector<std::uint32_t>& indices);

/// Normalises all normals. A normal of zero length or with a NaN becomes the area-weighted mean of its triangles'
/// normals (+z if these are degenerate too). Returns the number of replaced normals.
/// positions: a number per vertex, such as its position's; vertices of one number share that mean, though
/// they differ in texture coordinates. Empty: each vertex has its own.
std::size_t repair_normals(std::span<Vertex> vertices, std::span<const std::uint32_t> indices,
                           std::span<const std::uint32_t> positions = {});

/// A rectangle of `size` (metres) in the xy plane, centred on the origin: normal +z, tangent +x, four vertices, two
/// triangles, material 0. Texture coordinates run from (0, 0) at the top left to `uv_tiling` at the bottom right (glTF:
/// v points down), in both sets.
[[nodiscard]] Mesh make_plane(glm::vec2 size, glm::vec2 uv_tiling);

/// Splits edges at their middle until none is longer than `longest` metres, which may be infinite. New vertices have
/// the means of their edge's values, without normalising normals and tangents, so that interpolation is unchanged. The
/// vertices of `mesh` come first, in order. Whether an edge is split depends only on its ends, so triangles still meet.
/// shape: the same triangles in another pose, by whose edges `mesh` is split, so that poses have equal triangles; null:
/// its own. Throws std::logic_error: `longest` is not above 0.
[[nodiscard]] Mesh subdivided(const Mesh& mesh, float longest, const Mesh* shape = nullptr);

}  // namespace footprint
