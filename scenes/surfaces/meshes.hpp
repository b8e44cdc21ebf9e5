// The meshes of surfaces: the square of the flat ones, grids bent into shape, and solids turned on a lathe.
#pragma once

#include <functional>
#include <span>

#include "renderer/scene/surface.hpp"
#include "scenes/surfaces/height.hpp"

namespace footprint {

/// A point in space as a formula of two coordinates, whose derivatives it carries.
struct BentPoint {
  Height x, y, z;
};

/// The vertex at `point`: tangent along the first coordinate, normal along the cross product of both derivatives, which
/// must not be parallel; `uv` in both sets of texture coordinates.
[[nodiscard]] Vertex bent_vertex(const BentPoint& point, const glm::dvec2& uv);

/// A square of 2 x 2 m in the xy plane, facing +z, which the maps cover once. Surface::mesh of the flat surfaces.
[[nodiscard]] Mesh square_mesh(const SurfaceSettings& settings);

/// Rows and columns of cells, two triangles each, over the unit square. `vertex_at` returns the vertex at (s, t), s to
/// the right and t upwards as seen from outside; it must be finite.
[[nodiscard]] Mesh grid_mesh(int columns, int rows, const std::function<Vertex(const glm::dvec2& st)>& vertex_at);

/// One step of a profile, from the end of the previous one.
struct Cut {
  glm::dvec2 to;  ///< distance from the axis, height
  double bulge =
      0.0;            ///< of an arc, the tangent of a quarter of its angle: above 0 the solid bulges out; 0 is straight
  double wave = 0.0;  ///< height of the waves of the solid's edge there
};

/// The profile of a solid that is turned about the y axis: from the axis at `start` along the cuts to the axis.
struct Profile {
  double start = 0.0;  ///< height
  std::span<const Cut> cuts;
  int waves = 0;  ///< around the edges of cuts that have them
};

/// The solid. Its first texture coordinate runs around it, its second down along the profile; the tangent goes around.
/// Cuts meet in edges, and are smooth in themselves. `columns` around, and a row for every `row` of a cut's length and
/// every 18 degrees of its arc.
[[nodiscard]] Mesh turned_mesh(const Profile& profile, int columns, double row);

/// grid_mesh of a point as a formula of (s, t), without the triangles that have no area because a row of the grid
/// shrinks to a point. Texture coordinates are `uv_of` (s, t).
[[nodiscard]] Mesh pinched_grid_mesh(int columns, int rows, const std::function<BentPoint(const HeightPoint&)>& point,
                                     const std::function<glm::dvec2(const glm::dvec2&)>& uv_of);

}  // namespace footprint
