// Directions over the hemisphere with solid angles, and figures of NDFs over them.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/lobes/lobe.hpp"

namespace footprint {

/// Directions with the solid angle that each stands for; the sum of all is 2 pi.
struct HemisphereGrid {
  int resolution = 0;                 ///< rings
  std::vector<glm::vec3> directions;  ///< unit, z > 0
  std::vector<double> solid_angles;
};

inline constexpr int smallest_resolution = 16, largest_resolution = 2048;

/// Gauss-Legendre quadrature in z with `resolution` rings, and on each ring evenly spaced directions, as far from each
/// other as the rings are at most (2.2 / resolution radians). Exact up to the horizon, where an even grid would have
/// steps, and for smooth densities as exact as Gauss quadrature is.
[[nodiscard]] HemisphereGrid hemisphere_grid(int resolution);

/// The resolution whose directions lie half a width of the lobe apart, from 64 on and at most `largest_resolution`:
/// sums over the grid then integrate the lobe and its square to 1e-4 and miss no peak by more than 6%.
[[nodiscard]] int resolution_for(const Lobe& narrowest);

/// About how many directions a grid has.
[[nodiscard]] double direction_count(int resolution);

/// The directions of the pixel centres of a size x size image of the disc |(x, y)| < 1, x to the right, y up, row 0
/// on top; (0, 0, 0) outside of it.
[[nodiscard]] std::vector<glm::vec3> disc_directions(int size);

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
