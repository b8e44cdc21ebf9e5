// Spherical EM from two starts, after which lobes that Eq. 8 could not tell apart are joined.
#include "methods/iwasaki_sg/ndf_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "renderer/lobes/lobe.hpp"

namespace footprint::iwasaki_sg {
namespace {

// More discretised normals than these are pooled before EM, which looks at each many times.
constexpr std::size_t most_normals = 2048;
constexpr int most_iterations = 60;
constexpr double tolerance = 1e-5;  // of the mean log-likelihood, for each step
constexpr double least_share = 1e-6;
constexpr double most_condition = 1e5;

// What the E-step leaves of the normals for one lobe.
struct Moments {
  glm::dvec3 sum{0.0};
  double weight = 0.0;
};

struct Mixture {
  std::vector<SphericalGaussian> lobes;
  std::vector<double> shares;
};

// The M-step of one lobe. A normal stands for a lobe of `sharpest`, whose mean vector is short of 1 by its inverse.
SphericalGaussian lobe_of(const Moments& moments, const SphericalGaussian& before) {
  const double length = glm::length(moments.sum);
  if (!(length > 1e-12 * moments.weight) || !(moments.weight > 0.0)) return {before.axis, 1e-2};
  const double r = std::min(length / moments.weight, 1.0) * (1.0 - 1.0 / sharpest);
  return {moments.sum / length, std::clamp(vmf_kappa_of_shortfall(1.0 - r), 1e-2, sharpest)};
}

void maximise(std::span<const Moments> moments, double total, Mixture& mixture) {
  for (std::size_t j = 0; j < moments.size(); ++j) {
    mixture.shares[j] = moments[j].weight / total;
    if (moments[j].weight > 0.0) mixture.lobes[j] = lobe_of(moments[j], mixture.lobes[j]);
  }
}

// The E-step: sums for the M-step, and the mean log-likelihood of the mixture. Log-sum-exp: no lobe of 1e6 underflows.
double expect(std::span<const WeightedNormal> normals, double total, const Mixture& mixture,
              std::span<Moments> moments) {
  std::array<double, most_lobes> constant{};
  std::array<double, most_lobes> terms{};
  const std::size_t count = mixture.lobes.size();
  for (std::size_t j = 0; j < count; ++j) {
    constant.at(j) = std::log(std::max(mixture.shares[j], 1e-300) / vmf_integral(mixture.lobes[j].sharpness));
    moments[j] = {};
  }
  double likelihood = 0.0;
  for (const WeightedNormal& n : normals) {
    const glm::dvec3 axis = glm::normalize(n.normal);
    for (std::size_t j = 0; j < count; ++j) {
      terms.at(j) = constant.at(j) - mixture.lobes[j].sharpness * one_minus_dot(mixture.lobes[j].axis, axis);
    }
    const double largest = *std::max_element(terms.begin(), terms.begin() + static_cast<std::ptrdiff_t>(count));
    double sum = 0.0;
    for (std::size_t j = 0; j < count; ++j) sum += terms.at(j) = std::exp(terms.at(j) - largest);
    for (std::size_t j = 0; j < count; ++j) {
      const double weight = n.weight * terms.at(j) / sum;
      moments[j].sum += weight * n.normal;
      moments[j].weight += weight;
    }
    likelihood += n.weight * (largest + std::log(sum));
  }
  return likelihood / total;
}

// Normals to start from, far apart: the heaviest normal, then always the one whose squared distance from those taken,
// times its weight to the power `weighting`, is largest.
std::vector<glm::dvec3> spread_seeds(std::span<const WeightedNormal> normals, std::size_t count, double weighting) {
  const auto heaviest = std::ranges::max_element(normals, {}, &WeightedNormal::weight);
  std::vector<glm::dvec3> seeds{glm::normalize(heaviest->normal)};
  std::vector<double> distances(normals.size(), std::numeric_limits<double>::infinity());
  while (seeds.size() < count) {
    double best = 0.0;
    glm::dvec3 next(0.0);
    for (std::size_t i = 0; i < normals.size(); ++i) {
      const glm::dvec3 axis = glm::normalize(normals[i].normal);
      distances[i] = std::min(distances[i], one_minus_dot(axis, seeds.back()));
      const double score = distances[i] * std::pow(normals[i].weight, weighting);
      if (score > best) {
        best = score;
        next = axis;
      }
    }
    if (!(best > 0.0)) break;
    seeds.push_back(next);
  }
  return seeds;
}

// Every normal to its nearest seed, and the M-step of that.
Mixture clustered(std::span<const WeightedNormal> normals, double total, std::span<const glm::dvec3> seeds) {
  Mixture mixture;
  std::vector<Moments> moments(seeds.size());
  for (const glm::dvec3& seed : seeds) mixture.lobes.push_back({seed, 1.0});
  mixture.shares.resize(seeds.size());
  for (const WeightedNormal& n : normals) {
    const glm::dvec3 axis = glm::normalize(n.normal);
    const auto nearest =
        std::ranges::min_element(seeds, {}, [&](const glm::dvec3& seed) { return one_minus_dot(axis, seed); });
    Moments& own = moments[static_cast<std::size_t>(nearest - seeds.begin())];
    own.sum += n.weight * n.normal;
    own.weight += n.weight;
  }
  maximise(moments, total, mixture);
  return mixture;
}

double iterate(std::span<const WeightedNormal> normals, double total, Mixture& mixture) {
  std::vector<Moments> moments(mixture.lobes.size());
  double before = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < most_iterations; ++i) {
    const double likelihood = expect(normals, total, mixture, moments);
    maximise(moments, total, mixture);
    if (likelihood - before < tolerance) return likelihood;
    before = likelihood;
  }
  return before;
}

// Joins the lobes that Eq. 8 could not tell apart: the condition number of a pair is (1 + c) / (1 - c).
void merge(Mixture& mixture) {
  constexpr double most = (most_condition - 1.0) / (most_condition + 1.0);
  for (std::size_t a = 0; a < mixture.lobes.size(); ++a) {
    for (std::size_t b = a + 1; b < mixture.lobes.size();) {
      if (correlation(mixture.lobes[a], mixture.lobes[b]) <= most) {
        ++b;
        continue;
      }
      mixture.shares[a] += mixture.shares[b];
      mixture.lobes.erase(mixture.lobes.begin() + static_cast<std::ptrdiff_t>(b));
      mixture.shares.erase(mixture.shares.begin() + static_cast<std::ptrdiff_t>(b));
    }
  }
}

}  // namespace

double own_sharpness(double sharpness) { return 1.0 / std::max(1.0 / sharpness - 1.0 / sharpest, 1e-9); }

double correlation(const SphericalGaussian& a, const SphericalGaussian& b) {
  return convolution(a, b) / std::sqrt(convolution(a, a) * convolution(b, b));
}

NdfFit fit_ndf(std::span<const WeightedNormal> normals, int count) {
  const std::vector<WeightedNormal> pooled = pool_normals({normals.begin(), normals.end()}, most_normals);
  if (pooled.empty()) return {{SphericalGaussian{{0.0, 0.0, 1.0}, sharpest}}, {1.0}};
  double total = 0.0;
  for (const WeightedNormal& n : pooled) total += n.weight;
  Mixture best;
  double most = -std::numeric_limits<double>::infinity();
  for (const double weighting : {1.0, 0.0}) {
    Mixture mixture =
        clustered(pooled, total, spread_seeds(pooled, static_cast<std::size_t>(std::max(count, 1)), weighting));
    const double likelihood = iterate(pooled, total, mixture);
    if (likelihood > most) {
      most = likelihood;
      best = std::move(mixture);
    }
  }
  merge(best);
  NdfFit fit;
  double kept = 0.0;
  for (std::size_t j = 0; j < best.lobes.size(); ++j) {
    if (best.shares[j] < least_share) continue;
    fit.lobes.push_back(best.lobes[j]);
    fit.shares.push_back(best.shares[j]);
    kept += best.shares[j];
  }
  for (double& share : fit.shares) share /= kept;
  return fit;
}

}  // namespace footprint::iwasaki_sg
