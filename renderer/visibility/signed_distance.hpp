// What a point sees of all directions, as signed distances to the edge of what it sees (Wang et al. 2009, section 4).
#pragma once

#include <bitset>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/visibility/occluders.hpp"

namespace footprint {

/// Directions a side of the octahedral grid on which visibility is asked: 1024 rays a point, about 6 degrees apart.
inline constexpr int visibility_edge = 32;

/// For each direction of the grid, row by row, whether nothing lies in it.
using SphereVisibility = std::bitset<std::size_t{visibility_edge} * visibility_edge>;

/// The directions of the grid, the middles of its cells, unit.
[[nodiscard]] const std::vector<glm::vec3>& visibility_directions();

/// The cell that a direction (of any length but 0) lies in.
[[nodiscard]] std::size_t visibility_cell(const glm::dvec3& direction);

/// What a surface point sees: of what is above the plane of its `normal` (unit) what no triangle hides; below it
/// nothing, or with an open horizon all. Rays start before the surface by the occluders' offset.
[[nodiscard]] SphereVisibility visibility_at(const Occluders& occluders, const glm::vec3& point,
                                             const glm::vec3& normal, Horizon horizon = Horizon::cut);

/// The angle from each of `directions` (unit) to the nearest edge between visible and hidden, in radians, -pi to pi:
/// above 0 where the direction is visible, below where it is hidden. An edge lies halfway between two neighbours of
/// the grid. Without an edge: pi where all is visible, -pi where nothing is.
[[nodiscard]] std::vector<float> signed_distances(const SphereVisibility& visible,
                                                  std::span<const glm::vec3> directions);

}  // namespace footprint
