// The sphere on a square (Praun and Hoppe 2003), +y in the middle; the C++ twin of environment_stack.glsl's.
#pragma once

#include <glm/glm.hpp>

namespace footprint {

/// The position of a direction, of any length but 0, on the unit square.
[[nodiscard]] glm::dvec2 octahedral_uv(const glm::dvec3& direction);

/// The unit direction at a position. Outside of the unit square, up to half a square away, what lies across the edge.
[[nodiscard]] glm::dvec3 octahedral_direction(const glm::dvec2& uv);

/// The direction of texel (x, y) of a map of `size` x `size` texels whose outermost ones are a border that repeats what
/// lies across the edge.
[[nodiscard]] glm::dvec3 bordered_texel_direction(int size, int x, int y);

/// The solid angle of a small area of the unit square around a direction, over that area.
[[nodiscard]] double octahedral_stretch(const glm::dvec3& direction);

}  // namespace footprint
