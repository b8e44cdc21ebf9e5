// What surfaces lie on: the square of the flat ones, and grids bent into shape.
#pragma once

#include <functional>

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

/// Rows and columns of cells, two triangles each, over the unit square: `vertex_at` gives the vertex at (s, t), s to
/// the right and t upwards as seen from outside. Vertices that are not finite are a fault of the caller.
[[nodiscard]] Mesh grid_mesh(int columns, int rows, const std::function<Vertex(const glm::dvec2& st)>& vertex_at);

}  // namespace footprint
