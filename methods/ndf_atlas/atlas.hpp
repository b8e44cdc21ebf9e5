// Packs the tables of all levels into one texture. The block of each texel contains the tables of its four bilinear
// neighbours in four channels, so that one fetch blends nodes and texels at once.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "methods/ndf_atlas/lattice.hpp"
#include "renderer/bake/prefiltered.hpp"
#include "renderer/core/progress.hpp"

namespace footprint::ndf_atlas {

/// The tables of one level: node (i, j) of texel (x, y) is at ((y width + x) nodes.y + j) nodes.x + i.
struct LevelTables {
  int width = 0, height = 0;
  std::size_t nodes = 0;        ///< of each table
  std::vector<float> density;   ///< per solid angle: the mean over the valid facets under the texel
  std::vector<float> coverage;  ///< per texel: the share that has valid facets

  [[nodiscard]] std::span<const float> table(std::size_t texel) const {
    return std::span(density).subspan(texel * nodes, nodes);
  }
  [[nodiscard]] std::span<float> table(std::size_t texel) { return std::span(density).subspan(texel * nodes, nodes); }
};

/// The tables of `level`, 0 being the finest. Equal arguments give equal values at any number of threads.
[[nodiscard]] LevelTables tables_of(const Facets& facets, const Lattice& lattice, int level, const Progress& progress);

/// The next coarser level: means over areas, as in a mip chain.
[[nodiscard]] LevelTables coarser(const LevelTables& fine);

/// Subtracts a twelfth of the second differences along both axes from the node values, clamps nodes to 0, and preserves
/// the sum. A bilinear lookup is off by an eighth of the second differences in the middle of a cell and by a twelfth on
/// average, so this removes half of the error. The density is 0 beyond the lattice.
void correct_for_bilinear(std::span<float> table, const Lattice& lattice);

/// Sets the outermost nodes above the horizon to 0, because a lookup beyond the lattice returns its border.
void close_border(std::span<float> table, const Lattice& lattice);

/// The rounding to bytes: the error of each node is passed on to the next one, row by row in alternating direction, so
/// that the sum over a table stays within half a step. Or each node to the nearest, which loses everything below half a
/// step.
enum class Rounding { diffused, nearest };

/// `table` divided by `scale`, in bytes.
[[nodiscard]] std::vector<std::uint8_t> bytes_of(std::span<const float> table, int width, float scale,
                                                 Rounding rounding);

/// The blocks of all levels from `first_level` on, in sequence, in rows of `columns` blocks (a power of two).
struct AtlasLayout {
  int first_level = 0;
  glm::ivec2 nodes{2};
  int columns = 1;
  int rows = 1;

  [[nodiscard]] std::size_t byte_count(Storage storage) const;
};

/// The number of nodes of all blocks, with four tables each, of a normal map of width x height texels from a level on.
[[nodiscard]] double node_count(int width, int height, const Lattice& lattice, int first_level);

/// The layout of such a map. A texture of 16384 texels per edge has room for up to 480 megabytes. Errors:
/// std::logic_error if it does not fit.
[[nodiscard]] AtlasLayout layout_for(int width, int height, const Lattice& lattice, int first_level);

/// The textures `ndf_atlas_densities`, nodes divided by the scale of their table, and `ndf_atlas_blocks`, two texels
/// per block with the scales and the coverages of its four tables. `finest`: the uncorrected tables of the first level.
[[nodiscard]] std::array<PrefilteredTexture, 2> atlas_textures(LevelTables finest, const Lattice& lattice,
                                                               const AtlasLayout& layout, Storage storage,
                                                               const std::array<Wrap, 2>& wrap);

}  // namespace footprint::ndf_atlas
