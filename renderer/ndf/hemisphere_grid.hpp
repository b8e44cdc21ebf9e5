// Quadrature over the hemisphere, and statistics of NDFs.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/lobes/lobe.hpp"

namespace footprint {

/// Directions and the solid angle of each; the sum is 2 pi.
struct HemisphereGrid {
  int resolution = 0;                 ///< rings
  std::vector<glm::vec3> directions;  ///< unit, z > 0
  std::vector<double> solid_angles;
};

inline constexpr int smallest_resolution = 16, largest_resolution = 2048;

/// Gauss-Legendre quadrature in z with `resolution` rings. Directions on a ring are evenly spaced, at most as far apart
/// as the rings (2.2 / resolution radians). The horizon is represented exactly, unlike on an even grid, and smooth
/// densities converge as Gauss quadrature does.
[[nodiscard]] HemisphereGrid hemisphere_grid(int resolution);

/// The resolution whose directions are half a lobe width apart; at least 64 and at most `largest_resolution`. Sums over
/// the grid integrate the lobe and its square to 1e-4 and miss the peak by at most 6%.
[[nodiscard]] int resolution_for(const Lobe& narrowest);

/// The approximate number of directions of a grid.
[[nodiscard]] double direction_count(int resolution);

/// The directions of the pixel centres in a size x size image of the disc |(x, y)| < 1, with x to the right, y up and
/// row 0 at the top. (0, 0, 0) outside the disc.
[[nodiscard]] std::vector<glm::vec3> disc_directions(int size);

/// Statistics of a density D against a reference R, over a grid. Not finite if a density is not finite.
struct NdfFigures {
  double l2 = 0.0;      ///< sqrt(int (D - R)^2 / int R^2), over solid angle
  double energy = 0.0;  ///< int D / int R
  double peak = 0.0;    ///< the largest D
};

/// Compares densities with a reference, both per solid angle at the directions of the grid.
[[nodiscard]] NdfFigures compare_ndfs(const HemisphereGrid& grid, std::span<const float> densities,
                                      std::span<const double> reference);

/// The largest density; NaN if a density is not finite.
[[nodiscard]] double largest_density(std::span<const float> densities);

/// The integral over the hemisphere and the largest density.
struct NdfTotals {
  double energy = 0.0, peak = 0.0;
};
[[nodiscard]] NdfTotals ndf_totals(const HemisphereGrid& grid, std::span<const double> densities);

}  // namespace footprint
