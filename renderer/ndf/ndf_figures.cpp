// Sums over the quadrature of the hemisphere.
#include "renderer/ndf/ndf_figures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace footprint {

NdfFigures compare_ndfs(const HemisphereGrid& grid, std::span<const float> densities, std::span<const double> truth) {
  double error = 0.0, square = 0.0, energy = 0.0, true_energy = 0.0;
  for (std::size_t i = 0; i < grid.solid_angles.size(); ++i) {
    const double d = densities[i];
    const double difference = d - truth[i];
    error += difference * difference * grid.solid_angles[i];
    square += truth[i] * truth[i] * grid.solid_angles[i];
    energy += d * grid.solid_angles[i];
    true_energy += truth[i] * grid.solid_angles[i];
  }
  return {std::sqrt(error / square), energy / true_energy, largest_density(densities)};
}

double largest_density(std::span<const float> densities) {
  double largest = 0.0;
  for (const double d : densities) {
    if (!std::isfinite(d)) return std::numeric_limits<double>::quiet_NaN();
    largest = std::max(largest, d);
  }
  return largest;
}

NdfTotals ndf_totals(const HemisphereGrid& grid, std::span<const double> densities) {
  NdfTotals totals;
  for (std::size_t i = 0; i < grid.solid_angles.size(); ++i) {
    totals.energy += densities[i] * grid.solid_angles[i];
    totals.peak = std::max(totals.peak, densities[i]);
  }
  return totals;
}

}  // namespace footprint
