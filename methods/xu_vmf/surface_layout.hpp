// Where the triangles of a material lie in a map of which each texel shows one point of the surface.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "renderer/scene/geometry.hpp"
#include "renderer/scene/material.hpp"

namespace footprint::xu_vmf {

/// Texels that an atlas has at most: 0.5 GiB of `xu_vmf:j=adaptive` in 32-bit floats.
inline constexpr std::size_t largest_atlas = std::size_t{1} << 23U;

/// Nor longer: OpenGL 4.5 promises no larger textures than drivers have, all of which take this.
inline constexpr int longest_side = 16384;

/// Texels between two charts of an atlas, so that no level up to 3 blends one with another.
inline constexpr int chart_gap = 16;

/// A layout, or why there is none.
struct SurfaceLayout {
  glm::ivec2 size{1};                  ///< texels
  std::vector<glm::vec2> coordinates;  ///< a vertex, 0 to 1 over the size; where there is none, those of the map itself
  bool unique = true;                  ///< false: there is none
  std::string note;                    ///< what a user should know; empty where the map's own layout serves
};

/// Lays triangles out in texels as large as those of a map of `map_size` at `coordinates`: as the map has them where
/// they stay inside and do not overlap, else in an atlas, chart by chart (triangles that share vertices), each moved by
/// whole texels, so that a texel of the atlas shows exactly one of the map. None where coordinates are not finite, a
/// chart overlaps itself, the atlas is over `largest_atlas` or `longest_side`, or more than 1/1000 of the surface's
/// area would have no texel: coordinates that are not there or lie on a line, charts smaller than a texel.
[[nodiscard]] SurfaceLayout lay_out(const TriangleSoup& soup, const TextureCoordinates& coordinates,
                                    const glm::ivec2& map_size);

}  // namespace footprint::xu_vmf
