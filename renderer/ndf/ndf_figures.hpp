// What tells a method's NDF from the true one: error, energy and peak over the hemisphere.
#pragma once

#include <span>

#include "renderer/ndf/hemisphere_grid.hpp"

namespace footprint {

/// Sums over the directions of a grid. Not finite where a density is not.
struct NdfFigures {
  double l2 = 0.0;      ///< sqrt(int (D - truth)^2 / int truth^2), over solid angle
  double energy = 0.0;  ///< int D / int truth
  double peak = 0.0;    ///< the largest D
};

/// `densities` and `truth` at the grid's directions, per solid angle.
[[nodiscard]] NdfFigures compare_ndfs(const HemisphereGrid& grid, std::span<const float> densities,
                                      std::span<const double> truth);

/// The largest of some densities; not a number where one is not finite.
[[nodiscard]] double largest_density(std::span<const float> densities);

/// The integral over the hemisphere, and the largest density.
struct NdfTotals {
  double energy = 0.0, peak = 0.0;
};
[[nodiscard]] NdfTotals ndf_totals(const HemisphereGrid& grid, std::span<const double> densities);

}  // namespace footprint
