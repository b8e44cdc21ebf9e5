// Densities of normals over a lattice for every texel of a level, as sums over its facets.
#pragma once

#include <span>
#include <vector>

#include "methods/ndf_atlas/lattice.hpp"
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

}  // namespace footprint::ndf_atlas
