// Runs spherical EM from two starts and merges lobes that are too close for Eq. 8. Solves Eq. 8 for every pair of
// directions with non-negative amplitudes, and conserves the visible area.
#include "methods/iwasaki_sg/lobe_fit.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "renderer/environment/reference_tables.hpp"
#include "renderer/lobes/lobe.hpp"
#include "renderer/scene/environment.hpp"

namespace footprint::iwasaki_sg {
namespace {

// Discretised normals above this number are pooled before EM, which visits each many times.
constexpr std::size_t most_normals = 2048;
constexpr int most_iterations = 60;
constexpr double tolerance = 1e-5;  // of the mean log-likelihood, for each step
constexpr double least_share = 1e-6;
constexpr double most_condition = 1e5;

// The sums of the E-step for one lobe.
struct Moments {
  glm::dvec3 sum{0.0};
  double weight = 0.0;
};

// The M-step of one lobe. A normal represents a lobe of `sharpest`, whose mean vector is shorter than 1 by its inverse.
SphericalGaussian lobe_of(const Moments& moments, const SphericalGaussian& before) {
  const double length = glm::length(moments.sum);
  if (!(length > 1e-12 * moments.weight) || !(moments.weight > 0.0)) return {before.axis, 1e-2};
  const double r = std::min(length / moments.weight, 1.0) * (1.0 - 1.0 / sharpest);
  return {moments.sum / length, std::clamp(vmf_kappa_of_shortfall(1.0 - r), 1e-2, sharpest)};
}

void maximise(std::span<const Moments> moments, double total, NdfFit& mixture) {
  for (std::size_t j = 0; j < moments.size(); ++j) {
    mixture.shares[j] = moments[j].weight / total;
    if (moments[j].weight > 0.0) mixture.lobes[j] = lobe_of(moments[j], mixture.lobes[j]);
  }
}

// The E-step: sums for the M-step, and the mean log-likelihood of the mixture, by log-sum-exp so that no lobe of 1e6
// underflows.
double expect(std::span<const WeightedNormal> normals, double total, const NdfFit& mixture,
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

// Distant start normals: the heaviest, then repeatedly the one with the largest squared distance from those chosen,
// times its weight to the power `weighting`.
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

// Assigns every normal to its nearest seed, followed by the M-step.
NdfFit clustered(std::span<const WeightedNormal> normals, double total, std::span<const glm::dvec3> seeds) {
  NdfFit mixture;
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

double iterate(std::span<const WeightedNormal> normals, double total, NdfFit& mixture) {
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

// Merges lobes that are too close for Eq. 8: the condition number of a pair is (1 + c) / (1 - c).
void merge(NdfFit& mixture) {
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

constexpr double ridge = 1e-5;       // on the unit diagonal, so that nearly equal lobes share instead of cancelling
constexpr double least_area = 1e-6;  // of the patch, below which a direction sees nothing

// One pair of directions and one channel.
class Solver {
 public:
  explicit Solver(std::span<const SphericalGaussian> lobes) : matrix_(correlations(lobes)) {
    const auto n = static_cast<Eigen::Index>(lobes.size());
    matrix_ += ridge * LobeMatrix::Identity(n, n);
    inverse_ = matrix_.ldlt().solve(LobeMatrix::Identity(n, n));
    norms_.resize(n);
    integrals_.resize(n);
    for (Eigen::Index j = 0; j < n; ++j) {
      const SphericalGaussian& lobe = lobes[static_cast<std::size_t>(j)];
      norms_[j] = std::sqrt(convolution(lobe, lobe));
      integrals_[j] = vmf_integral(lobe.sharpness);
    }
  }

  /// The masses for right sides `products`, one per lobe.
  [[nodiscard]] LobeVector masses(const LobeVector& products, Energy energy) const {
    const LobeVector scaled = products.cwiseQuotient(norms_);
    LobeVector x = inverse_ * scaled;
    if (energy != Energy::any_sign && (x.array() < 0.0).any()) x = solve_non_negative(matrix_, scaled);
    return x.cwiseProduct(integrals_.cwiseQuotient(norms_));
  }

 private:
  LobeMatrix matrix_, inverse_;
  LobeVector norms_, integrals_;
};

// Scales masses to the sum `total`. If no lobe reaches the normal, all masses are equal.
void conserve(LobeVector& masses, double total) {
  const double sum = masses.sum();
  if (sum > 1e-12 * total) {
    masses *= total / sum;
  } else {
    masses.setConstant(total / static_cast<double>(masses.size()));
  }
}

constexpr double even_sharpness = 1e-2;  // of light from all sides alike

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
  NdfFit best;
  double most = -std::numeric_limits<double>::infinity();
  for (const double weighting : {1.0, 0.0}) {
    NdfFit mixture =
        clustered(pooled, total, spread_seeds(pooled, static_cast<std::size_t>(std::max(count, 1)), weighting));
    const double likelihood = iterate(pooled, total, mixture);
    if (likelihood > most) {
      most = likelihood;
      best = std::move(mixture);
    }
  }
  merge(best);
  NdfFit fit;
  for (std::size_t j = 0; j < best.lobes.size(); ++j) {
    if (best.shares[j] < least_share) continue;
    fit.lobes.push_back(best.lobes[j]);
    fit.shares.push_back(best.shares[j]);
  }
  const double remaining = std::accumulate(fit.shares.begin(), fit.shares.end(), 0.0);
  for (double& share : fit.shares) share /= remaining;
  return fit;
}

LobeMatrix correlations(std::span<const SphericalGaussian> lobes) {
  const auto n = static_cast<Eigen::Index>(lobes.size());
  return LobeMatrix::NullaryExpr(n, n, [&](Eigen::Index i, Eigen::Index j) {
    return i == j ? 1.0 : correlation(lobes[static_cast<std::size_t>(i)], lobes[static_cast<std::size_t>(j)]);
  });
}

LobeVector solve_non_negative(const LobeMatrix& a, const LobeVector& b) {
  const Eigen::Index n = b.size();
  const double threshold = 1e-12 * b.cwiseAbs().maxCoeff();
  LobeVector x = LobeVector::Zero(n);
  std::vector<int> free;
  const int most_rounds = 3 * static_cast<int>(n) + 3;  // far more than needed; bounds the loop against rounding
  for (int round = 0; round < most_rounds; ++round) {
    LobeVector gradient = b - a * x;
    for (const int i : free) gradient[i] = 0.0;
    Eigen::Index next = 0;
    if (!(gradient.maxCoeff(&next) > threshold)) break;
    free.push_back(static_cast<int>(next));
    // Step towards the free solution, and fix at 0 those that would become negative, until none does.
    while (!free.empty()) {
      const LobeVector wanted = LobeMatrix(a(free, free)).ldlt().solve(LobeVector(b(free)));
      double step = 1.0;
      for (std::size_t i = 0; i < free.size(); ++i) {
        const double from = x[free[i]], to = wanted[static_cast<Eigen::Index>(i)];
        if (to <= 0.0) step = std::min(step, from / std::max(from - to, 1e-300));
      }
      x(free) += step * (wanted - x(free));
      if (step >= 1.0) break;
      std::erase_if(free, [&](int i) {
        const bool clamped = x[i] <= threshold;
        if (clamped) x[i] = 0.0;
        return clamped;
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
        LobeVector masses = solver.masses(products, energy);
        if (energy == Energy::conserved) conserve(masses, total);
        for (std::size_t j = 0; j < lobes.size(); ++j) {
          out.masses[(j * channels + c) * pairs + pair] = static_cast<float>(masses[static_cast<Eigen::Index>(j)]);
        }
      }
    }
  });
  return out;
}

glm::vec4 lobe_texel(const SphericalGaussian& lobe) {
  return {glm::vec3(lobe.axis), static_cast<float>(lobe.sharpness)};
}

Image texel_rows(std::size_t width, std::span<const glm::vec4> texels) {
  Image image(static_cast<int>(width), static_cast<int>(texels.size() / width), 4);
  std::copy_n(&texels.front().x, image.texels.size(), image.texels.begin());
  return image;
}

std::vector<LightGaussian> light_gaussians(const Environment& environment) {
  const std::vector<DenseLight> lights = dense_lights(suns_apart(environment).rest);
  std::vector<WeightedNormal> directions;
  for (const DenseLight& light : lights) {
    const glm::dvec3 color(light.irradiance);
    directions.push_back({glm::normalize(glm::dvec3(light.direction)), color.x + color.y + color.z});
  }
  if (directions.empty()) return {};
  const NdfFit fit = fit_ndf(directions, environment_gaussians);
  std::vector<LightGaussian> gaussians;
  for (const SphericalGaussian& lobe : fit.lobes) gaussians.push_back({.lobe = lobe});
  for (const DenseLight& light : lights) {
    std::vector<double> weights;
    for (std::size_t k = 0; k < gaussians.size(); ++k) {
      const SphericalGaussian& lobe = gaussians[k].lobe;
      weights.push_back(std::log(fit.shares[k]) -
                        lobe.sharpness * one_minus_dot(lobe.axis, glm::dvec3(light.direction)) -
                        std::log(vmf_integral(lobe.sharpness)));
    }
    const double largest = *std::ranges::max_element(weights);
    double sum = 0.0;
    for (double& weight : weights) sum += weight = std::exp(weight - largest);
    for (std::size_t k = 0; k < gaussians.size(); ++k)
      gaussians[k].light += weights[k] / sum * glm::dvec3(light.irradiance);
  }
  return gaussians;
}

PrefilteredTexture environment_texture(const Environment& environment) {
  std::vector<LightGaussian> gaussians = light_gaussians(environment);
  if (gaussians.empty()) gaussians.push_back({.lobe = {.axis = {0.0, 0.0, 1.0}, .sharpness = even_sharpness}});
  std::vector<glm::vec4> texels;
  for (const LightGaussian& gaussian : gaussians) texels.push_back(lobe_texel(gaussian.lobe));
  for (const LightGaussian& gaussian : gaussians) texels.emplace_back(glm::vec3(gaussian.light), 0.0F);
  return make_texture("iwasaki_environment", {texel_rows(gaussians.size(), texels)}, Storage::fp32, {});
}

}  // namespace footprint::iwasaki_sg
