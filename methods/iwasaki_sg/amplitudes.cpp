// Solves Eq. 8 for every pair of directions, without negative amplitudes, and conserves what is seen.
#include "methods/iwasaki_sg/amplitudes.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/lobes/lobe.hpp"

namespace footprint::iwasaki_sg {
namespace {

constexpr double ridge = 1e-5;       // on the unit diagonal: lobes that nearly coincide share, and do not cancel
constexpr double least_area = 1e-6;  // of the patch, below which a direction sees nothing

// The solution over the members of `free` alone.
LobeVector solve_subset(const LobeMatrix& a, const LobeVector& b, std::span<const int> free) {
  const auto n = static_cast<Eigen::Index>(free.size());
  LobeMatrix part(n, n);
  LobeVector side(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    side[i] = b[free[static_cast<std::size_t>(i)]];
    for (Eigen::Index j = 0; j < n; ++j)
      part(i, j) = a(free[static_cast<std::size_t>(i)], free[static_cast<std::size_t>(j)]);
  }
  return part.ldlt().solve(side);
}

// One pair of directions and one channel.
class Solver {
 public:
  explicit Solver(std::span<const SphericalGaussian> lobes) : matrix_(correlations(lobes)) {
    const auto n = static_cast<Eigen::Index>(lobes.size());
    matrix_ += ridge * LobeMatrix::Identity(n, n);
    inverse_ = matrix_.ldlt().solve(LobeMatrix::Identity(n, n));
    for (const SphericalGaussian& lobe : lobes) {
      norms_.push_back(std::sqrt(convolution(lobe, lobe)));
      integrals_.push_back(vmf_integral(lobe.sharpness));
    }
  }

  /// Masses for right sides `products` (one a lobe).
  [[nodiscard]] LobeVector masses(const LobeVector& products) const {
    LobeVector scaled = products;
    for (Eigen::Index j = 0; j < scaled.size(); ++j) scaled[j] /= norms_[static_cast<std::size_t>(j)];
    LobeVector x = inverse_ * scaled;
    if ((x.array() < 0.0).any()) x = solve_non_negative(matrix_, scaled);
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      x[j] *= integrals_[static_cast<std::size_t>(j)] / norms_[static_cast<std::size_t>(j)];
    }
    return x;
  }

 private:
  LobeMatrix matrix_, inverse_;
  std::vector<double> norms_, integrals_;
};

// Scales masses to the sum `total`. A normal that no lobe reaches leaves nothing to scale: its mass is then shared
// evenly.
void conserve(LobeVector& masses, double total) {
  const double sum = masses.sum();
  if (sum > 1e-12 * total) {
    masses *= total / sum;
  } else {
    masses.setConstant(total / static_cast<double>(masses.size()));
  }
}

}  // namespace

LobeMatrix correlations(std::span<const SphericalGaussian> lobes) {
  const auto n = static_cast<Eigen::Index>(lobes.size());
  LobeMatrix a(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      a(i, j) = i == j ? 1.0 : correlation(lobes[static_cast<std::size_t>(i)], lobes[static_cast<std::size_t>(j)]);
    }
  }
  return a;
}

LobeVector solve_non_negative(const LobeMatrix& a, const LobeVector& b) {
  const Eigen::Index n = b.size();
  const double threshold = 1e-12 * b.cwiseAbs().maxCoeff();
  LobeVector x = LobeVector::Zero(n);
  std::vector<int> free;
  const int most_rounds = 3 * static_cast<int>(n) + 3;  // never needed by far; rounding must not make it endless
  for (int round = 0; round < most_rounds; ++round) {
    LobeVector gradient = b - a * x;
    for (const int i : free) gradient[i] = 0.0;
    Eigen::Index next = 0;
    if (!(gradient.maxCoeff(&next) > threshold)) break;
    free.push_back(static_cast<int>(next));
    // Step towards the free solution, and hold at 0 what would leave the cone, until nothing does.
    while (!free.empty()) {
      const LobeVector wanted = solve_subset(a, b, free);
      double step = 1.0;
      for (std::size_t i = 0; i < free.size(); ++i) {
        const double from = x[free[i]], to = wanted[static_cast<Eigen::Index>(i)];
        if (to <= 0.0) step = std::min(step, from / std::max(from - to, 1e-300));
      }
      for (std::size_t i = 0; i < free.size(); ++i)
        x[free[i]] += step * (wanted[static_cast<Eigen::Index>(i)] - x[free[i]]);
      if (step >= 1.0) break;
      std::erase_if(free, [&](int i) {
        const bool held = x[i] <= threshold;
        if (held) x[i] = 0.0;
        return held;
      });
    }
  }
  return x.cwiseMax(0.0);
}

Amplitudes solve_amplitudes(const Bvndf& bvndf, const BvndfSums& sums, std::span<const SphericalGaussian> lobes,
                            Energy energy) {
  const std::size_t n = sums.directions, pairs = n * n, channels = sums.channels;
  Amplitudes out{
      .lobes = {lobes.begin(), lobes.end()}, .directions = n, .channels = channels, .masses = {}, .diffuse = {}};
  out.masses.resize(lobes.size() * channels * pairs);
  out.diffuse.resize(channels * pairs);
  const Solver solver(lobes);
  const double least = least_area * bvndf.total_area();
  tbb::parallel_for(std::size_t{0}, n, [&](std::size_t wi) {
    LobeVector products(static_cast<Eigen::Index>(lobes.size()));
    for (std::size_t wo = 0; wo < n; ++wo) {
      if (bvndf.visible_area[wo] < least) continue;
      const double scale = 1.0 / bvndf.visible_area[wo];
      for (std::size_t c = 0; c < channels; ++c) {
        const std::size_t pair = wi * n + wo;
        const double total = scale * sums.totals[c * pairs + pair];
        out.diffuse[c * pairs + pair] = static_cast<float>(scale * sums.diffuse[c * pairs + pair]);
        if (!(total > 0.0)) continue;
        for (std::size_t j = 0; j < lobes.size(); ++j) {
          products[static_cast<Eigen::Index>(j)] = scale * sums.products[(c * lobes.size() + j) * pairs + pair];
        }
        LobeVector masses = solver.masses(products);
        if (energy == Energy::conserved) conserve(masses, total);
        for (std::size_t j = 0; j < lobes.size(); ++j) {
          out.masses[(j * channels + c) * pairs + pair] = static_cast<float>(masses[static_cast<Eigen::Index>(j)]);
        }
      }
    }
  });
  return out;
}

}  // namespace footprint::iwasaki_sg
