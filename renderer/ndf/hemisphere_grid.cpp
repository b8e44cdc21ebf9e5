// Gauss-Legendre rings, and sums over their directions.
#include "renderer/ndf/hemisphere_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace footprint {
namespace {

using std::numbers::pi;

// The largest angle between neighbouring nodes in z, times their number: pi sqrt(z / (1 + z)) at z = 1.
constexpr double ring_spacing = pi / std::numbers::sqrt2;

struct Node {
  double z, weight;
};

// Node `i` of the Gauss-Legendre rule with n nodes on [0, 1], by Newton's method on Legendre's polynomial.
Node legendre_node(int i, int n) {
  constexpr int rounds = 8;
  double x = std::cos(pi * (i + 0.75) / (n + 0.5));
  double slope = 0.0;
  for (int round = 0; round < rounds; ++round) {
    double value = x, before = 1.0;
    for (int k = 2; k <= n; ++k) {
      const double next = ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k;
      before = std::exchange(value, next);
    }
    slope = n * (x * value - before) / (x * x - 1.0);
    x -= value / slope;
  }
  return {0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope)};
}

}  // namespace

HemisphereGrid hemisphere_grid(int resolution) {
  constexpr double fewest_on_a_ring = 8.0;  // around the pole
  HemisphereGrid grid{resolution, {}, {}};
  for (int i = 0; i < resolution; ++i) {
    const Node node = legendre_node(i, resolution);
    const double sine = std::sqrt(1.0 - node.z * node.z);
    const double count = std::ceil(2.0 * pi * sine * resolution / ring_spacing) + fewest_on_a_ring;
    for (double k = 0.5; k < count; k += 1.0) {
      const double azimuth = 2.0 * pi * k / count;
      grid.directions.emplace_back(sine * std::cos(azimuth), sine * std::sin(azimuth), node.z);
      grid.solid_angles.push_back(2.0 * pi * node.weight / count);
    }
  }
  return grid;
}

int resolution_for(const Lobe& narrowest) {
  constexpr double least = 64.0;
  const double rings = ring_spacing / (0.5 * lobe_width(narrowest));
  return static_cast<int>(std::ceil(std::clamp(rings, least, static_cast<double>(largest_resolution))));
}

double direction_count(int resolution) {
  return resolution * (2.0 * pi * resolution / ring_spacing + 8.0);  // no ring has more than the horizon's
}

std::vector<glm::vec3> disc_directions(int size) {
  std::vector<glm::vec3> directions;
  directions.reserve(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) {
      const double x = 2.0 * (column + 0.5) / size - 1.0;
      const double y = 1.0 - 2.0 * (row + 0.5) / size;
      const double z2 = 1.0 - x * x - y * y;
      directions.push_back(z2 > 0.0 ? glm::vec3(x, y, std::sqrt(z2)) : glm::vec3(0.0F));
    }
  }
  return directions;
}

NdfFigures compare_ndfs(const HemisphereGrid& grid, std::span<const float> densities,
                        std::span<const double> reference) {
  double error = 0.0, square = 0.0, energy = 0.0, reference_energy = 0.0;
  for (std::size_t i = 0; i < grid.solid_angles.size(); ++i) {
    const double d = densities[i];
    const double difference = d - reference[i];
    error += difference * difference * grid.solid_angles[i];
    square += reference[i] * reference[i] * grid.solid_angles[i];
    energy += d * grid.solid_angles[i];
    reference_energy += reference[i] * grid.solid_angles[i];
  }
  return {std::sqrt(error / square), energy / reference_energy, largest_density(densities)};
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
