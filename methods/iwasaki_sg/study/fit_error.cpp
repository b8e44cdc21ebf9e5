// Compares convolutions over angles, and lobes with the BVNDF over every cell and pair of directions.
#include "methods/iwasaki_sg/study/fit_error.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "renderer/microgeometry/direction_grid.hpp"

namespace footprint::iwasaki_sg {
namespace {

// The cell of a normal in a cube map that is turned, so that facets along the axes, which are common, have their
// normals inside a cell and not where four meet: a lobe about them then lies in one. Turned by this angle, all six axes
// lie a third of a cell or more from every border, five times the width of the sharpest lobe.
std::uint32_t turned_cell(const glm::dvec3& normal) {
  static const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), 0.784, glm::normalize(glm::dvec3(1.0, 2.0, 3.0))));
  return cube_cell(turn * normal, cube_side);
}

// The point of a face of the cube, (u, v) from -1 to 1.
glm::dvec3 cube_point(int face, double u, double v) {
  glm::dvec3 point(0.0);
  point[face / 2] = face % 2 == 0 ? 1.0 : -1.0;
  point[(face / 2 + 1) % 3] = u;
  point[(face / 2 + 2) % 3] = v;
  return point;
}

// Adds what a lobe holds in the cell of a face about (u, v), by steps^2 sub-cells, to the cells of the turned cube map.
void add_shares(const SphericalGaussian& lobe, int face, glm::dvec2 middle, int steps, std::span<double> own) {
  constexpr double cell_width = 2.0 / cube_side;
  const double width = cell_width / steps;
  for (int y = 0; y < steps; ++y) {
    for (int x = 0; x < steps; ++x) {
      const glm::dvec2 at = middle + (glm::dvec2(x, y) + 0.5) * width - 0.5 * cell_width;
      const glm::dvec3 point = cube_point(face, at.x, at.y);
      const double length = glm::length(point);
      const glm::dvec3 direction = point / length;
      own[turned_cell(direction)] += value(lobe, direction) * width * width / (length * length * length);
    }
  }
}

// Each lobe's share in each cell of the cube map, [lobe][cell]: sub-cells as fine as its width asks for.
std::vector<std::vector<double>> shares_in_cells(std::span<const SphericalGaussian> lobes) {
  std::vector<std::vector<double>> shares;
  constexpr double cell_width = 2.0 / cube_side;
  constexpr int finest = 32;
  constexpr double nothing = 40.0;  // an exponent below which a lobe adds nothing
  for (const SphericalGaussian& lobe : lobes) {
    const int steps = std::clamp(static_cast<int>(std::ceil(2.0 * cell_width * std::sqrt(lobe.sharpness))), 1, finest);
    // From the axis to the middle of the last cell that the lobe reaches.
    const double reach = std::acos(std::max(1.0 - nothing / lobe.sharpness, -1.0)) + cell_width;
    const double beyond = 1.0 - std::cos(std::min(reach, std::numbers::pi));
    std::vector<double>& own = shares.emplace_back(6 * cube_side * cube_side);
    for (int cell = 0; cell < 6 * cube_side * cube_side; ++cell) {
      const glm::dvec2 middle = (glm::dvec2(cell % cube_side, cell / cube_side % cube_side) + 0.5) * cell_width - 1.0;
      const int face = cell / (cube_side * cube_side);
      const glm::dvec3 direction = glm::normalize(cube_point(face, middle.x, middle.y));
      if (one_minus_dot(direction, lobe.axis) <= beyond) add_shares(lobe, face, middle, steps, own);
    }
    const double sum = std::accumulate(own.begin(), own.end(), 0.0);
    for (double& share : own) share /= sum;
  }
  return shares;
}

struct Sums {
  double squares = 0.0;      // of gamma~
  double differences = 0.0;  // of gamma~ less the lobes, squared
};

// What one pair of directions adds. Over the cells that have facets the difference is summed as it is; over the others
// the lobes stand alone: all of their products less those over the former.
class PairSums {
 public:
  PairSums(const Bvndf& bvndf, const Amplitudes& table, Cosines cosines)
      : bvndf_(bvndf), table_(table), cosines_(cosines), shares_(shares_in_cells(table.lobes)) {
    for (std::size_t i = 0; i < bvndf.bins.size(); ++i) bins_in_[turned_cell(bvndf.bins[i].normal)].push_back(i);
    const std::size_t n = shares_.size();
    elsewhere_.resize(n * n);
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t b = 0; b < n; ++b) {
        for (std::size_t cell = 0; cell < shares_[a].size(); ++cell) {
          if (!bins_in_.contains(static_cast<std::uint32_t>(cell)))
            elsewhere_[a * n + b] += shares_[a][cell] * shares_[b][cell];
        }
      }
    }
  }

  [[nodiscard]] Sums of(std::size_t wi, std::size_t wo) const {
    Sums sums;
    if (bvndf_.visible_area[wo] <= 0.0) return sums;
    const std::size_t n = shares_.size(), pairs = table_.directions * table_.directions;
    const auto mass = [&](std::size_t j) { return double{table_.masses[j * pairs + wi * table_.directions + wo]}; };
    for (const auto& [cell, bins] : bins_in_) {
      double truth = 0.0;
      for (const std::size_t bin : bins) truth += seen(bin, wi, wo);
      double difference = truth;
      for (std::size_t j = 0; j < n; ++j) difference -= mass(j) * shares_[j][cell];
      sums.squares += truth * truth;
      sums.differences += difference * difference;
    }
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t b = 0; b < n; ++b) sums.differences += mass(a) * mass(b) * elsewhere_[a * n + b];
    }
    return sums;
  }

 private:
  // gamma~ of a bin.
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
  std::map<std::uint32_t, std::vector<std::size_t>> bins_in_;  // of each cell that has facets
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

// The largest difference of a stand-in from Eq. 11 over the angle between the axes.
template <class Approximation>
double largest_difference(double sharpness1, double sharpness2, const Approximation& approximation) {
  // Dense where both forms live: up to where the exponent of Eq. 14 has fallen to -40, or to the antipode.
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

// By how much the mean vector of a vMF lobe is shorter than 1: 1 - coth k + 1 / k, without the cancellation.
double short_of_one(double sharpness) { return 1.0 / sharpness - 2.0 / std::expm1(2.0 * sharpness); }

// The inverse, which falls from 1 to 0: bisection on the logarithm.
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
