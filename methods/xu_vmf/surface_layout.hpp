// Lays out the triangles of a material in a map in which each texel shows one point of the surface.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "renderer/scene/geometry.hpp"
#include "renderer/scene/material.hpp"

namespace footprint::xu_vmf {

/// The most texels of an atlas: 0.5 GiB of `xu_vmf:j=adaptive` in 32-bit floats.
inline constexpr std::size_t largest_atlas = std::size_t{1} << 23U;

/// The most texels along an edge; all drivers support it, though OpenGL 4.5 guarantees no such size.
inline constexpr int longest_side = 16384;

/// Texels between two charts of an atlas, so that levels up to 3 do not blend charts.
inline constexpr int chart_gap = 16;

/// A layout, or the reason for its absence.
struct SurfaceLayout {
  glm::ivec2 size{1};                  ///< texels
  std::vector<glm::vec2> coordinates;  ///< per vertex, 0 to 1 over the size; without a layout those of the map
  bool unique = true;                  ///< false: no layout
  std::string note;                    ///< a note for the user; empty if the map's own layout is used
};

/// Lays triangles out in texels as large as those of a map of `map_size` at `coordinates`. Keeps the map's own layout
/// if triangles stay inside and do not overlap. Otherwise packs charts (triangles that share vertices) into an atlas,
/// each moved by whole texels, so that a texel of the atlas shows exactly one of the map. No layout if coordinates are
/// not finite, a chart overlaps itself, the atlas is too large, or more than 1/1000 of the surface has no texel, as
/// with missing or collinear coordinates and charts smaller than a texel.
[[nodiscard]] SurfaceLayout lay_out(const TriangleSoup& soup, const TextureCoordinates& coordinates,
                                    const glm::ivec2& map_size);

}  // namespace footprint::xu_vmf
