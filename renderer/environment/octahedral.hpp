// The sphere on a square (Praun and Hoppe 2003), +y in the middle; the C++ twin of environment_stack.glsl's.
#pragma once

#include <glm/glm.hpp>

namespace footprint {

/// The position of a direction, of any length but 0, on the unit square.
[[nodiscard]] glm::dvec2 octahedral_uv(const glm::dvec3& direction);

/// The unit direction at a position. Positions up to half outside of the unit square continue across the edge.
[[nodiscard]] glm::dvec3 octahedral_direction(const glm::dvec2& uv);

/// The direction of texel (x, y) in a map of `size` x `size` texels with a border of one texel that continues across
/// the edge.
[[nodiscard]] glm::dvec3 bordered_texel_direction(int size, int x, int y);

/// The solid angle per area of the unit square at a direction.
[[nodiscard]] double octahedral_stretch(const glm::dvec3& direction);

}  // namespace footprint
