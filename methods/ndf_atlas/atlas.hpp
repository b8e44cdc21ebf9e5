// Tables of all levels packed into one texture: each texel's block has the tables of its four bilinear neighbours in
// four channels, so that one fetch blends nodes and texels at once.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "methods/ndf_atlas/densities.hpp"
#include "renderer/bake/prefiltered.hpp"

namespace footprint::ndf_atlas {

/// How bytes are rounded: the error of each node is handed on to the next, row by row and back, so that the sum over a
/// table stays within half a step; or each to the nearest, which loses what is below half a step.
enum class Rounding { diffused, nearest };

/// `table` over `scale` in bytes.
[[nodiscard]] std::vector<std::uint8_t> bytes_of(std::span<const float> table, int width, float scale,
                                                 Rounding rounding);

/// Blocks of all levels from `first_level` on, one behind the other in rows of `columns` blocks, a power of two.
struct AtlasLayout {
  int first_level = 0;
  glm::ivec2 nodes{2};
  int columns = 1;
  int rows = 1;

  [[nodiscard]] std::size_t byte_count(Storage storage) const;
};

/// The nodes of all four tables of all blocks of a normal map of width x height texels from a level on.
[[nodiscard]] double node_count(int width, int height, const Lattice& lattice, int first_level);

/// The layout of such a map. Errors: std::logic_error where a texture cannot hold it, of 16384 texels along an edge: up
/// to 480 megabytes of bytes it can.
[[nodiscard]] AtlasLayout layout_for(int width, int height, const Lattice& lattice, int first_level);

/// The textures `ndf_atlas_densities`, nodes over the scale of their table, and `ndf_atlas_blocks`: two texels a
/// block, the scales and coverages of its four tables. `finest` are the tables of the first level, not yet corrected.
[[nodiscard]] std::array<PrefilteredTexture, 2> atlas_textures(LevelTables finest, const Lattice& lattice,
                                                               const AtlasLayout& layout, Storage storage,
                                                               const std::array<Wrap, 2>& wrap);

}  // namespace footprint::ndf_atlas
