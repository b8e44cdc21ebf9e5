// Compares convolutions over angles, and lobes with the BVNDF over every cell and pair of directions.
#include "methods/iwasaki_sg/study/effective_brdf.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

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
  double occupied = 0.0;     // of these differences, over cells with facets
  double cells = 0.0;        // with facets

  Sums& operator+=(const Sums& other) {
    squares += other.squares;
    differences += other.differences;
    occupied += other.occupied;
    cells += other.cells;
    return *this;
  }
};

// What fits are measured on: the patch as of one colour.
struct Fitted {
  Bvndf bvndf;
  Amplitudes table;
  Cosines cosines;

  Fitted(Patch patch, TableSettings settings) : cosines(settings.cosines) {
    settings.channels = 1;
    settings.paints.assign(1, {});
    patch.paints.clear();
    bvndf = patch_bvndf(patch, settings, no_progress);
    table = patch_table(patch, settings, no_progress).amplitudes;
  }

  // gamma~ of a bin for a pair of directions.
  [[nodiscard]] double seen(std::size_t bin, std::size_t wi, std::size_t wo) const {
    const auto cosine = [&](std::size_t d) {
      return std::max(glm::dot(bvndf.bins[bin].normal, bvndf.directions[d]), 0.0);
    };
    const double value = bvndf.gamma(bin, wi, wo) * cosine(wo) / bvndf.visible_area[wo];
    return cosines == Cosines::published ? value * cosine(wi) : value;
  }

  // The sum of `sums_of(wi)` over all directions.
  template <class SumsOf>
  [[nodiscard]] Sums total(const SumsOf& sums_of) const {
    std::vector<Sums> rows(bvndf.directions.size());
    tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t wi) { rows[wi] = sums_of(wi); });
    Sums sum;
    for (const Sums& row : rows) sum += row;
    return sum;
  }
};

// Lobes and facets over the cells of the cube. A facet's normal is as wide as the sharpest lobe, so that a lobe for a
// single normal fits it exactly.
struct CellShares {
  std::vector<std::vector<double>> lobes;                                     // by cell
  std::map<std::uint32_t, std::vector<std::pair<std::size_t, double>>> bins;  // of each cell with facets
  std::vector<double> elsewhere;  // the products of lobes, summed over the other cells

  explicit CellShares(const Fitted& fitted) {
    const std::vector<glm::dvec3> middles = cell_middles();
    for (const SphericalGaussian& lobe : fitted.table.lobes) {
      std::vector<double>& own = lobes.emplace_back(middles.size());
      for (const auto& [cell, share] : spread_of(lobe, middles)) own[cell] = share;
    }
    for (std::size_t i = 0; i < fitted.bvndf.bins.size(); ++i) {
      for (const auto& [cell, share] : spread_of({fitted.bvndf.bins[i].normal, sharpest}, middles))
        bins[cell].emplace_back(i, share);
    }
    const std::size_t n = lobes.size();
    elsewhere.resize(n * n);
    for (std::size_t cell = 0; cell < middles.size(); ++cell) {
      if (bins.contains(static_cast<std::uint32_t>(cell))) continue;
      for (std::size_t i = 0; i < n * n; ++i) elsewhere[i] += lobes[i / n][cell] * lobes[i % n][cell];
    }
  }
};

// The contribution of one pair of directions. The difference is summed directly over cells with facets. Over the other
// cells only lobes contribute, by their products.
Sums pair_sums(const Fitted& fitted, const CellShares& shares, std::size_t wi, std::size_t wo) {
  Sums sums;
  if (fitted.bvndf.visible_area[wo] <= 0.0) return sums;
  const std::size_t n = shares.lobes.size();
  const auto mass = [&](std::size_t j) { return fitted.table.mass(j, 0, wi, wo); };
  for (const auto& [cell, bins] : shares.bins) {
    double exact = 0.0;
    for (const auto& [bin, share] : bins) exact += share * fitted.seen(bin, wi, wo);
    double difference = exact;
    for (std::size_t j = 0; j < n; ++j) difference -= mass(j) * shares.lobes[j][cell];
    sums.squares += exact * exact;
    sums.differences += difference * difference;
  }
  sums.occupied = sums.differences;
  sums.cells = static_cast<double>(shares.bins.size());
  for (std::size_t i = 0; i < n * n; ++i) sums.differences += mass(i / n) * mass(i % n) * shares.elsewhere[i];
  return sums;
}

// The integrals of products of lobes of unit energy: those of unit amplitudes over both integrals.
Eigen::MatrixXd products(const std::vector<SphericalGaussian>& a, const std::vector<SphericalGaussian>& b) {
  const auto product = [&](Eigen::Index i, Eigen::Index j) {
    const SphericalGaussian &one = a[static_cast<std::size_t>(i)], &other = b[static_cast<std::size_t>(j)];
    return convolution(one, other) / (vmf_integral(one.sharpness) * vmf_integral(other.sharpness));
  };
  return Eigen::MatrixXd::NullaryExpr(static_cast<Eigen::Index>(a.size()), static_cast<Eigen::Index>(b.size()),
                                      product);
}

// The largest difference of an approximation from Eq. 11 over the angle between the axes.
double largest_difference(
    double sharpness1, double sharpness2,
    const std::function<double(const SphericalGaussian&, const SphericalGaussian&)>& approximation) {
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
  return largest_difference(sharpness1, sharpness2, approximate_convolution);
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

FitErrors fit_errors(const Patch& patch, const TableSettings& settings) {
  const Fitted fitted(patch, settings);
  const CellShares shares(fitted);
  const std::size_t n = fitted.bvndf.directions.size();
  const Sums sum = fitted.total([&](std::size_t wi) {
    Sums row;
    for (std::size_t wo = 0; wo < n; ++wo) row += pair_sums(fitted, shares, wi, wo);
    return row;
  });
  return {.rms = std::sqrt(sum.differences / (6.0 * cube_side * cube_side * static_cast<double>(n * n))),
          .relative = std::sqrt(sum.differences / sum.squares),
          .occupied = std::sqrt(sum.occupied / sum.cells)};
}

double convolved_fit_rms(const Patch& patch, const TableSettings& settings, double sharpness) {
  const Fitted fitted(patch, settings);
  std::vector<SphericalGaussian> facets, lobes = fitted.table.lobes;
  for (const NormalBin& bin : fitted.bvndf.bins) facets.push_back({bin.normal, sharpest});
  for (auto* const both : {&facets, &lobes})
    for (SphericalGaussian& lobe : *both) lobe.sharpness *= sharpness / (lobe.sharpness + sharpness);
  const Eigen::MatrixXd of_facets = products(facets, facets), mixed = products(facets, lobes),
                        of_lobes = products(lobes, lobes);
  const auto n = static_cast<Eigen::Index>(fitted.bvndf.directions.size());
  const Sums sum = fitted.total([&](std::size_t wi) {
    const auto values = [&](Eigen::Index rows, const auto& value) {
      return Eigen::MatrixXd(Eigen::MatrixXd::NullaryExpr(rows, n, [&](Eigen::Index row, Eigen::Index wo) {
        const auto to = static_cast<std::size_t>(wo);
        return fitted.bvndf.visible_area[to] > 0.0 ? value(static_cast<std::size_t>(row), to) : 0.0;
      }));
    };
    const Eigen::MatrixXd exact =
        values(of_facets.rows(), [&](std::size_t bin, std::size_t wo) { return fitted.seen(bin, wi, wo); });
    const Eigen::MatrixXd masses =
        values(of_lobes.rows(), [&](std::size_t lobe, std::size_t wo) { return fitted.table.mass(lobe, 0, wi, wo); });
    const double squares = exact.cwiseProduct(of_facets * exact).sum();
    return Sums{.squares = squares,
                .differences = squares - 2.0 * exact.cwiseProduct(mixed * masses).sum() +
                               masses.cwiseProduct(of_lobes * masses).sum()};
  });
  return std::sqrt(std::max(sum.differences, 0.0) / sum.squares);
}

}  // namespace footprint::iwasaki_sg
