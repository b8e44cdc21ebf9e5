// Polygons as triangles.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace footprint {

/// The most corners of a polygon that is not a fan about its first corner.
inline constexpr std::size_t most_concave_corners = 16384;

/// Triangles that cover a polygon in about a plane, with its winding, as numbers of its corners, three each: a fan
/// about the first corner if that covers it, as it does a convex one, else by cutting off ears (Meisters 1975). Corners
/// may coincide, so that a hole may be joined to the outline by an edge there and back. A polygon that crosses itself
/// is covered in part. corners: positions, in order; at least 3, and without a fan at most `most_concave_corners`.
/// Throws std::logic_error: too few or too many corners.
[[nodiscard]] std::vector<std::uint32_t> triangulated(std::span<const glm::dvec3> corners);

/// Whether a fan about the first corner covers a polygon.
[[nodiscard]] bool is_fan(std::span<const glm::dvec3> corners);

}  // namespace footprint
