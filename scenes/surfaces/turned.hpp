// Solids that are turned on a lathe, and others whose rows of vertices shrink to a point at their ends.
#pragma once

#include <functional>
#include <span>

#include "scenes/surfaces/meshes.hpp"

namespace footprint {

/// One step of a profile, from where the last one ended.
struct Cut {
  glm::dvec2 to;  ///< distance from the axis, height
  double bulge =
      0.0;            ///< of an arc, the tangent of a quarter of its angle: above 0 the solid bulges out; 0 is straight
  double wave = 0.0;  ///< how high the waves of the solid's edge are there
};

/// What turns about the y axis: from the axis at `start` along the cuts to the axis.
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
