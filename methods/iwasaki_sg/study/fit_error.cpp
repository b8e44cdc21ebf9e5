// Compares convolutions over angles, and lobes with the BVNDF over every cell and pair of directions.
#include "methods/iwasaki_sg/study/fit_error.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "renderer/microgeometry/direction_grid.hpp"

namespace footprint::iwasaki_sg {
namespace {

constexpr double cell_width = 2.0 / cube_side;

// The point of a face of the cube, (u, v) from -1 to 1.
glm::dvec3 cube_point(int face, double u, double v) {
  glm::dvec3 point(0.0);
  point[face / 2] = face % 2 == 0 ? 1.0 : -1.0;
  point[(face / 2 + 1) % 3] = u;
  point[(face / 2 + 2) % 3] = v;
  return point;
}

// Directions to the centres of a cube map's cells.
std::vector<glm::dvec3> cell_middles() {
  std::vector<glm::dvec3> middles;
  for (int cell = 0; cell < 6 * cube_side * cube_side; ++cell) {
    const glm::dvec2 at = (glm::dvec2(cell % cube_side, cell / cube_side % cube_side) + 0.5) * cell_width - 1.0;
    middles.push_back(glm::normalize(cube_point(cell / (cube_side * cube_side), at.x, at.y)));
  }
  return middles;
}

// The integral of a lobe over a cell, by steps^2 sub-cells.
double integral_over(const SphericalGaussian& lobe, int cell, int steps) {
  const glm::dvec2 corner = glm::dvec2(cell % cube_side, cell / cube_side % cube_side) * cell_width - 1.0;
  const double width = cell_width / steps;
  double sum = 0.0;
  for (int y = 0; y < steps; ++y) {
    for (int x = 0; x < steps; ++x) {
      const glm::dvec2 at = corner + (glm::dvec2(x, y) + 0.5) * width;
      const glm::dvec3 point = cube_point(cell / (cube_side * cube_side), at.x, at.y);
      const double length = glm::length(point);
      sum += value(lobe, point / length) * width * width / (length * length * length);
    }
  }
  return sum;
}

// A lobe over the cells that it reaches: (cell, share), with shares that sum to 1.
using Spread = std::vector<std::pair<std::uint32_t, double>>;

// Chooses sub-cells by the width of the lobe.
Spread spread_of(const SphericalGaussian& lobe, std::span<const glm::dvec3> middles) {
  constexpr int finest = 64;
  constexpr double nothing = 40.0;  // exponent beyond which a lobe is negligible
  const int steps = std::clamp(static_cast<int>(std::ceil(2.0 * cell_width * std::sqrt(lobe.sharpness))), 1, finest);
  // From the axis to the centre of the last cell that the lobe reaches.
  const double reach = std::acos(std::max(1.0 - nothing / lobe.sharpness, -1.0)) + cell_width;
  const double beyond = 1.0 - std::cos(std::min(reach, std::numbers::pi));
  Spread spread;
  double sum = 0.0;
  for (std::size_t cell = 0; cell < middles.size(); ++cell) {
    if (one_minus_dot(middles[cell], lobe.axis) > beyond) continue;
    const double share = integral_over(lobe, static_cast<int>(cell), steps);
    if (share <= 0.0) continue;
    spread.emplace_back(static_cast<std::uint32_t>(cell), share);
    sum += share;
  }
  for (auto& [cell, share] : spread) share /= sum;
  return spread;
}

struct Sums {
  double squares = 0.0;      // of gamma~
  double differences = 0.0;  // of gamma~ minus the lobes, squared
};

// The contribution of one pair of directions. A facet's normal is as wide as the sharpest lobe, so that a lobe for a
// single normal fits it exactly. The difference is summed directly over cells with facets. Over the other cells only
// lobes contribute, by their products.
class PairSums {
 public:
  PairSums(const Bvndf& bvndf, const Amplitudes& table, Cosines cosines)
      : bvndf_(bvndf), table_(table), cosines_(cosines) {
    const std::vector<glm::dvec3> middles = cell_middles();
    for (const SphericalGaussian& lobe : table.lobes) {
      std::vector<double>& own = shares_.emplace_back(middles.size());
      for (const auto& [cell, share] : spread_of(lobe, middles)) own[cell] = share;
    }
    for (std::size_t i = 0; i < bvndf.bins.size(); ++i) {
      for (const auto& [cell, share] : spread_of({bvndf.bins[i].normal, sharpest}, middles))
        bins_in_[cell].emplace_back(i, share);
    }
    const std::size_t n = shares_.size();
    elsewhere_.resize(n * n);
    for (std::size_t cell = 0; cell < middles.size(); ++cell) {
      if (bins_in_.contains(static_cast<std::uint32_t>(cell))) continue;
      for (std::size_t a = 0; a < n; ++a) {
        for (std::size_t b = 0; b < n; ++b) elsewhere_[a * n + b] += shares_[a][cell] * shares_[b][cell];
      }
    }
  }

  [[nodiscard]] Sums of(std::size_t wi, std::size_t wo) const {
    Sums sums;
    if (bvndf_.visible_area[wo] <= 0.0) return sums;
    const std::size_t n = shares_.size(), pairs = table_.directions * table_.directions;
    const auto mass = [&](std::size_t j) { return double{table_.masses[j * pairs + wi * table_.directions + wo]}; };
    for (const auto& [cell, bins] : bins_in_) {
      double exact = 0.0;
      for (const auto& [bin, share] : bins) exact += share * seen(bin, wi, wo);
      double difference = exact;
      for (std::size_t j = 0; j < n; ++j) difference -= mass(j) * shares_[j][cell];
      sums.squares += exact * exact;
      sums.differences += difference * difference;
    }
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t b = 0; b < n; ++b) sums.differences += mass(a) * mass(b) * elsewhere_[a * n + b];
    }
    return sums;
  }

 private:
  // Returns gamma~ of a bin.
  [[nodiscard]] double seen(std::size_t bin, std::size_t wi, std::size_t wo) const {
    const auto cosine = [&](std::size_t d) {
      return std::max(glm::dot(bvndf_.bins[bin].normal, bvndf_.directions[d]), 0.0);
    };
    const double value = bvndf_.gamma(bin, wi, wo) * cosine(wo) / bvndf_.visible_area[wo];
    return cosines_ == Cosines::published ? value * cosine(wi) : value;
  }

  const Bvndf& bvndf_;
  const Amplitudes& table_;
  Cosines cosines_;
  std::vector<std::vector<double>> shares_;
  std::map<std::uint32_t, std::vector<std::pair<std::size_t, double>>> bins_in_;  // of each cell with facets
  std::vector<double> elsewhere_;
};

// Means over all cells and pairs.
Sums mean_squares(const Patch& patch, TableSettings settings) {
  settings.channels = 1;
  settings.paints.assign(1, {});
  Patch plain = patch;
  plain.paints.clear();
  const Bvndf bvndf = patch_bvndf(plain, settings, no_progress);
  const MaterialTable table = patch_table(plain, settings, no_progress);
  const PairSums pair_sums(bvndf, table.amplitudes, settings.cosines);
  const std::size_t n = bvndf.directions.size();
  std::vector<Sums> rows(n);
  tbb::parallel_for(std::size_t{0}, n, [&](std::size_t wi) {
    for (std::size_t wo = 0; wo < n; ++wo) {
      const Sums pair = pair_sums.of(wi, wo);
      rows[wi].squares += pair.squares;
      rows[wi].differences += pair.differences;
    }
  });
  Sums mean;
  const double count = 6.0 * cube_side * cube_side * static_cast<double>(n * n);
  for (const Sums& row : rows) {
    mean.squares += row.squares / count;
    mean.differences += row.differences / count;
  }
  return mean;
}

// The largest difference of an approximation from Eq. 11 over the angle between the axes.
template <class Approximation>
double largest_difference(double sharpness1, double sharpness2, const Approximation& approximation) {
  // Dense where both forms matter: up to the angle at which the exponent of Eq. 14 has fallen to -40, or to the
  // antipode.
  constexpr int steps = 200'000;
  constexpr double nothing = 40.0;
  const double product = sharpness1 * sharpness2 / (sharpness1 + sharpness2);
  const double reach = std::acos(std::max(1.0 - nothing / product, -1.0));
  double largest = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const double angle = reach * i / steps;
    const SphericalGaussian a{{0.0, 0.0, 1.0}, sharpness1}, b{{std::sin(angle), 0.0, std::cos(angle)}, sharpness2};
    largest = std::max(largest, std::abs(convolution(a, b) - approximation(a, b)));
  }
  return largest;
}

// 1 minus the length of the mean vector of a vMF lobe: 1 - coth k + 1 / k, without cancellation.
double short_of_one(double sharpness) { return 1.0 / sharpness - 2.0 / std::expm1(2.0 * sharpness); }

// The inverse, which falls from 1 to 0, by bisection on the logarithm.
double sharpness_of(double short_by) {
  double low = std::log(1e-6), high = std::log(1e12);
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (short_of_one(std::exp(middle)) > short_by ? low : high) = middle;
  }
  return std::exp(0.5 * (low + high));
}

}  // namespace

double convolution_error(double sharpness1, double sharpness2) {
  return largest_difference(sharpness1, sharpness2, [](const SphericalGaussian& a, const SphericalGaussian& b) {
    return approximate_convolution(a, b);
  });
}

double jakob_convolution_error(double sharpness1, double sharpness2) {
  const double q1 = short_of_one(sharpness1), q2 = short_of_one(sharpness2);
  const double sharpness = sharpness_of(q1 + q2 - q1 * q2);
  const SphericalGaussian z1{{0.0, 0.0, 1.0}, sharpness1}, z2{{0.0, 0.0, 1.0}, sharpness2};
  const double peak = convolution(z1, z2);
  return largest_difference(sharpness1, sharpness2, [&](const SphericalGaussian& a, const SphericalGaussian& b) {
    return peak * value(SphericalGaussian{a.axis, sharpness}, b.axis);
  });
}

double fit_rms(const Patch& patch, const TableSettings& settings) {
  return std::sqrt(mean_squares(patch, settings).differences);
}

double relative_fit_rms(const Patch& patch, const TableSettings& settings) {
  const Sums mean = mean_squares(patch, settings);
  return std::sqrt(mean.differences / mean.squares);
}

}  // namespace footprint::iwasaki_sg
