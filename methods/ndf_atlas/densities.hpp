// Densities of normals over a lattice, for every texel of a level: sums over the facets under it.
#pragma once

#include <span>
#include <vector>

#include "methods/ndf_atlas/lattice.hpp"
#include "renderer/core/progress.hpp"

namespace footprint::ndf_atlas {

/// The tables of one level: node (i, j) of texel (x, y) at ((y width + x) nodes.y + j) nodes.x + i.
struct LevelTables {
  int width = 0, height = 0;
  std::size_t nodes = 0;        ///< of each table
  std::vector<float> density;   ///< per solid angle, the mean over the valid facets under the texel
  std::vector<float> coverage;  ///< of each texel: the share of it that has valid facets

  [[nodiscard]] std::span<const float> table(std::size_t texel) const {
    return std::span(density).subspan(texel * nodes, nodes);
  }
  [[nodiscard]] std::span<float> table(std::size_t texel) { return std::span(density).subspan(texel * nodes, nodes); }
};

/// Those of `level`, 0 the finest. Equal arguments give equal values at any number of threads.
[[nodiscard]] LevelTables tables_of(const Facets& facets, const Lattice& lattice, int level, const Progress& progress);

/// The next coarser level: means over areas, as all mip chains have them.
[[nodiscard]] LevelTables coarser(const LevelTables& fine);

/// Node values less a twelfth of their second differences along both axes, no node below 0, and the sum that these
/// leave: what a bilinear lookup between nodes is off by is mostly an eighth of the second differences in the middle of
/// a cell, a twelfth in the mean over it, so that half of the error is taken away. Beyond the lattice is nothing.
void correct_for_bilinear(std::span<float> table, const Lattice& lattice);

/// Sets the outermost nodes that lie above the horizon to 0: a lookup beyond the lattice stays at its border.
void close_border(std::span<float> table, const Lattice& lattice);

}  // namespace footprint::ndf_atlas
