// Sums the lobes of all facets whose cell reaches the direction, with a table of the lobe. Gauss-Legendre rings, and
// sums over their directions.
#include "renderer/ndf/reference_ndf.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "renderer/bake/facets.hpp"

namespace footprint {
namespace {

constexpr int cells_across = 96;  // of Lambert's disc
constexpr std::size_t chunk = 1 << 11;

int cell_of(const glm::dvec3& n) {
  const glm::dvec2 on_disc = glm::dvec2(n) / std::sqrt(std::max(1.0 + n.z, 1e-6));
  const glm::dvec2 cell = glm::clamp(glm::floor((on_disc + 1.0) * (0.5 * cells_across)), 0.0, cells_across - 1.0);
  return static_cast<int>(cell.y) * cells_across + static_cast<int>(cell.x);
}

// The integral of an anisotropic lobe over the upper hemisphere, by slopes at even steps of azimuth and of the radius
// of the round lobe that it is stretched from.
double anisotropic_energy(NormalDistribution distribution, const Alphas& alphas, double rotation,
                          const glm::dvec3& normal) {
  constexpr int rings = 96, spokes = 64;
  const double c = std::cos(rotation), s = std::sin(rotation);
  double sum = 0.0;
  for (int i = 0; i < rings; ++i) {
    const double w = (i + 0.5) / rings, radius = w / (1.0 - w);
    for (int j = 0; j < spokes; ++j) {
      const double azimuth = 2.0 * std::numbers::pi * (j + 0.5) / spokes;
      const glm::dvec2 slope(alphas.along * radius * std::cos(azimuth), alphas.across * radius * std::sin(azimuth));
      const glm::dvec3 own = glm::normalize(glm::dvec3(c * slope.x - s * slope.y, s * slope.x + c * slope.y, 1.0));
      if (turned_with_normal(own, normal).z <= 0.0) continue;
      const double area = radius / ((1.0 - w) * (1.0 - w));  // of the round lobe's slopes per dw and azimuth
      sum += anisotropic_density(distribution, alphas, rotation, own) * own.z * own.z * own.z * area;
    }
  }
  return sum * alphas.along * alphas.across * 2.0 * std::numbers::pi / (rings * spokes);
}

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

ReferenceNdf::ReferenceNdf(NormalDistribution distribution, const std::vector<WeightedFacet>& facets)
    : distribution_(distribution),
      anisotropic_(std::ranges::any_of(facets, [](const auto& f) { return f.stretch != glm::dvec2(0.0); })) {
  std::vector<std::pair<int, std::size_t>> order(facets.size());
  for (std::size_t i = 0; i < facets.size(); ++i) order[i] = {cell_of(facets[i].normal), i};
  std::ranges::sort(order);
  facets_.reserve(facets.size());
  for (std::size_t i = 0; i < order.size();) {
    const int number = order[i].first;
    Cell cell{glm::dvec3(0.0), 0.0, 0.0, i, i};
    double support = 0.0;
    for (; i < order.size() && order[i].first == number; ++i) {
      const WeightedFacet& f = facets[order[i].second];
      const Lobe lobe{distribution, f.parameter};
      facets_.push_back({f.normal, 0.5 * std::max(1.0 - glm::dot(f.normal, f.normal), 0.0), f.parameter,
                         anisotropic_ ? f.share : f.share * lobe_peak(lobe), f.stretch});
      support = std::max(support, lobe_support(anisotropic_ ? Lobe{distribution, alphas(facets_.back()).along} : lobe));
      cell.centre += f.normal;
    }
    cell.last = i;
    cell.centre /= static_cast<double>(cell.last - cell.first);
    for (std::size_t k = cell.first; k < cell.last; ++k) {
      cell.radius = std::max(cell.radius, glm::distance(facets_[k].normal, cell.centre));
    }
    cell.reach = std::sqrt(2.0 * support);
    cells_.push_back(cell);
  }
  const auto is_first = [&](const Facet& f) { return f.parameter == facets_.front().parameter; };
  if (!anisotropic_ && std::ranges::all_of(facets_, is_first))
    profile_.emplace(Lobe{distribution, facets_.front().parameter});
}

template <class Shape>
double ReferenceNdf::density(const glm::dvec3& direction, const Shape& shape) const {
  double sum = 0.0;
  for (const Cell& cell : cells_) {
    const glm::dvec3 from_centre = direction - cell.centre;
    const double reach = cell.radius + cell.reach;
    if (glm::dot(from_centre, from_centre) > reach * reach) continue;
    for (std::size_t i = cell.first; i < cell.last; ++i) {
      if (anisotropic_) {
        sum += facets_[i].amplitude * stretched(facets_[i], direction);
        continue;
      }
      const glm::dvec3 d = direction - facets_[i].normal;
      sum += facets_[i].amplitude * shape(facets_[i], 0.5 * glm::dot(d, d) + facets_[i].slack);
    }
  }
  return sum;
}

std::vector<double> ReferenceNdf::densities(std::span<const glm::vec3> directions, const Progress& progress) const {
  const auto shared_lobe = [this](const Facet& /*facet*/, double u) { return (*profile_)(u); };
  const auto own_lobe = [this](const Facet& facet, double u) {
    return lobe_shape({distribution_, facet.parameter}, u);
  };
  std::vector<double> out(directions.size());
  for (std::size_t first = 0; first < directions.size(); first += chunk) {
    progress("exact sum over the texels", static_cast<double>(first) / static_cast<double>(directions.size()));
    tbb::parallel_for(first, std::min(first + chunk, directions.size()), [&](std::size_t i) {
      if (directions[i] == glm::vec3(0.0F)) return;
      const glm::dvec3 h = glm::normalize(glm::dvec3(directions[i]));
      out[i] = profile_ ? density(h, shared_lobe) : density(h, own_lobe);
    });
  }
  return out;
}

Alphas ReferenceNdf::alphas(const Facet& facet) const { return alphas_of_stretch(facet.parameter, facet.stretch); }

double ReferenceNdf::stretched(const Facet& facet, const glm::dvec3& direction) const {
  const glm::dvec3 n = glm::normalize(facet.normal);
  return anisotropic_density(distribution_, alphas(facet), rotation_of_stretch(facet.stretch),
                             turned_with_normal(direction, {-n.x, -n.y, n.z}));
}

double ReferenceNdf::energy(const Facet& facet) const {
  const Lobe lobe{distribution_, facet.parameter};
  if (!anisotropic_) return facet.amplitude / lobe_peak(lobe) * lobe_energy(lobe, facet.normal.z);
  return facet.amplitude * anisotropic_energy(distribution_, alphas(facet), rotation_of_stretch(facet.stretch),
                                              glm::normalize(facet.normal));
}

double ReferenceNdf::expected_energy() const {
  return tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::size_t>(0, facets_.size(), 256), 0.0,
      [&](const tbb::blocked_range<std::size_t>& part, double sum) {
        for (std::size_t i = part.begin(); i < part.end(); ++i) sum += energy(facets_[i]);
        return sum;
      },
      [](double a, double b) { return a + b; });
}

Lobe ReferenceNdf::narrowest() const {
  const auto lobe = [&](const Facet& f) { return Lobe{distribution_, anisotropic_ ? alphas(f).across : f.parameter}; };
  return lobe(*std::ranges::min_element(facets_, {}, [&](const Facet& f) { return lobe_width(lobe(f)); }));
}

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
