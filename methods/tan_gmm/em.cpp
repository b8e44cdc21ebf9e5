// The E-step, the M-step with the prior, and their iteration. Isotropic Gaussians skip components without weight. Full
// covariances are fitted sample by sample in 64 bits: a reference for isotropic ones, not a fast method.
#include "methods/tan_gmm/em.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace footprint::tan_gmm {
namespace {

// The components with weight, in their order; the others have no responsibility.
struct Present {
  Terms terms;
  std::array<std::size_t, most_components> index{};  // in the mixture
  std::size_t count = 0;

  explicit Present(std::span<const Gaussian> mixture) {
    for (std::size_t i = 0; i < mixture.size(); ++i) {
      const Gaussian& g = mixture[i];
      if (g.alpha <= 0.0F) continue;
      terms.x[count] = g.x;
      terms.y[count] = g.y;
      terms.constant[count] = std::log(g.alpha / (2.0F * std::numbers::pi_v<float> * g.variance));
      terms.factor[count] = 0.5F / g.variance;
      index[count++] = i;
    }
  }
};

// The sums of a single component, which is responsible for all samples.
Sums sums_of_one(const Samples& samples, const Terms& terms) {
  Sums sums;
  for (std::size_t j = 0; j < samples.size(); ++j) {
    const double weight = samples.weight[j];
    const glm::dvec2 d = glm::dvec2(samples.at(j)) - glm::dvec2(terms.x[0], terms.y[0]);
    sums.weight[0] += weight;
    sums.dx[0] += weight * d.x;
    sums.dy[0] += weight * d.y;
    sums.square[0] += weight * (d.x * d.x + d.y * d.y + samples.spread[j]);
  }
  sums.log_likelihood = terms.constant[0] * sums.weight[0] - terms.factor[0] * sums.square[0];
  return sums;
}

// Sums over samples of weight times responsibility, about the component's mean before the step.
struct FullSums {
  double weight = 0;
  glm::dvec2 first{0.0};
  double xx = 0, xy = 0, yy = 0;

  void add(double w, const glm::dvec2& d, double spread) {
    weight += w;
    first += w * d;
    xx += w * (d.x * d.x + spread);
    xy += w * d.x * d.y;
    yy += w * (d.y * d.y + spread);
  }
};

// log(alpha g) as constant - (xx dx^2 + 2 xy dx dy + yy dy^2) / 2; -infinity for an absent component.
struct LogDensity {
  double constant = 0, xx = 0, xy = 0, yy = 0;

  explicit LogDensity(const FullGaussian& g) {
    const double a = g.xx + static_cast<double>(variance_floor);
    const double c = g.yy + static_cast<double>(variance_floor);
    const double determinant = std::max(a * c - g.xy * g.xy, 1e-14);
    constant = std::log(g.alpha / (2.0 * std::numbers::pi * std::sqrt(determinant)));
    xx = c / determinant;
    xy = -g.xy / determinant;
    yy = a / determinant;
  }
  // The mean over points of a variance `spread` per axis.
  [[nodiscard]] double at(const glm::dvec2& d, double spread) const {
    return constant - 0.5 * (xx * (d.x * d.x + spread) + yy * (d.y * d.y + spread)) - xy * d.x * d.y;
  }
};

using AllSums = std::array<FullSums, most_components>;

// The E-step; returns the log-likelihood. A sample with a spread contributes the mean log density of its points.
double expect(const Samples& samples, std::span<const FullGaussian> mixture, AllSums& sums) {
  const std::vector<LogDensity> densities(mixture.begin(), mixture.end());
  std::array<double, most_components> share{};
  sums.fill({});
  double likelihood = 0.0;
  for (std::size_t j = 0; j < samples.size(); ++j) {
    const double spread = 0.5 * static_cast<double>(samples.spread[j]), weight = samples.weight[j];
    const auto from_mean = [&](std::size_t k) {
      return glm::dvec2(samples.at(j)) - glm::dvec2(mixture[k].x, mixture[k].y);
    };
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < mixture.size(); ++k)
      most = std::max(most, share[k] = densities[k].at(from_mean(k), spread));
    double total = 0.0;
    for (std::size_t k = 0; k < mixture.size(); ++k) total += share[k] = std::exp(share[k] - most);
    likelihood += weight * (most + std::log(total));
    for (std::size_t k = 0; k < mixture.size(); ++k) sums[k].add(weight * share[k] / total, from_mean(k), spread);
  }
  return likelihood;
}

void maximise(const AllSums& sums, const Prior& prior, double total, std::span<FullGaussian> mixture) {
  for (std::size_t i = 0; i < mixture.size(); ++i) {
    FullGaussian& g = mixture[i];
    const FullSums& s = sums[i];
    if (s.weight <= 1e-12 * total) {
      g.alpha = 0.0;
      continue;
    }
    const glm::dvec2 own = s.first / s.weight;  // of the samples, relative to the mean before the step
    // (N I + pull S) d = N m + pull S (mu_0 - mu).
    const double pull = 2.0 * prior.weight(i);
    const double to_x = prior.mean_x(i) - g.x, to_y = prior.mean_y(i) - g.y;
    const double a = s.weight + pull * g.xx, b = pull * g.xy, c = s.weight + pull * g.yy;
    const double right_x = s.first.x + pull * (g.xx * to_x + g.xy * to_y);
    const double right_y = s.first.y + pull * (g.xy * to_x + g.yy * to_y);
    const double determinant = a * c - b * b;
    const glm::dvec2 d((c * right_x - b * right_y) / determinant, (a * right_y - b * right_x) / determinant);
    g.alpha = s.weight / total;
    g.x += d.x;
    g.y += d.y;
    // About the new mean: the scatter about the samples' mean plus the squared distance between the two means.
    const glm::dvec2 off = own - d;
    g.xx = std::max(s.xx / s.weight - own.x * own.x, 0.0) + off.x * off.x;
    g.yy = std::max(s.yy / s.weight - own.y * own.y, 0.0) + off.y * off.y;
    const double most = std::sqrt(g.xx * g.yy);
    g.xy = std::clamp(s.xy / s.weight - own.x * own.y + off.x * off.y, -most, most);
  }
}

// By how much a printed variance of component weight `weight` differs from the exact one, of M = `total` samples.
double printed_share(VarianceStep variance, double weight, double total) {
  if (variance == VarianceStep::exact) return 1.0;
  return variance == VarianceStep::published ? 1.0 / total : weight / total;
}

}  // namespace

void Prior::add(std::span<const Gaussian> neighbour) {
  for (std::size_t i = 0; i < neighbour.size(); ++i) {
    const double alpha = neighbour[i].alpha;
    if (alpha <= 0.0) continue;
    weight_[i] += alpha;
    const double share = alpha / weight_[i];
    x_[i] += share * (neighbour[i].x - x_[i]);
    y_[i] += share * (neighbour[i].y - y_[i]);
  }
}

double Prior::log_density(std::size_t i, double x, double y) const {
  const double dx = x - mean_x(i);
  const double dy = y - mean_y(i);
  return -weight(i) * (dx * dx + dy * dy);
}

Expectation expectation(const Samples& samples, std::span<const Gaussian> mixture) {
  const Present present(mixture);
  Expectation e;
  if (present.count == 0) return e;
  const Sums sums =
      present.count == 1 ? sums_of_one(samples, present.terms) : sums_over(samples, present.terms, present.count);
  e.log_likelihood = sums.log_likelihood;
  for (std::size_t k = 0; k < present.count; ++k) {
    if (sums.weight[k] <= 0) continue;
    const Gaussian& g = mixture[present.index[k]];
    const double dx = sums.dx[k] / sums.weight[k];
    const double dy = sums.dy[k] / sums.weight[k];
    e.moments[present.index[k]] = {.weight = sums.weight[k],
                                   .x = g.x + dx,
                                   .y = g.y + dy,
                                   .scatter = std::max(sums.square[k] - sums.weight[k] * (dx * dx + dy * dy), 0.0)};
  }
  return e;
}

void maximise(const Expectation& e, const Prior& prior, MStep step, std::span<Gaussian> mixture,
              VarianceStep variance) {
  double total = 0;
  for (std::size_t i = 0; i < mixture.size(); ++i) total += e.moments[i].weight;
  for (std::size_t i = 0; i < mixture.size(); ++i) {
    Gaussian& g = mixture[i];
    const Moments& m = e.moments[i];
    if (m.weight <= 1e-12 * total) {
      g.alpha = 0.0F;
      continue;
    }
    const double pull = prior.weight(i) * (step == MStep::exact ? 2.0 * g.variance : 1.0);
    const double x = (m.weight * m.x + pull * prior.mean_x(i)) / (m.weight + pull);
    const double y = (m.weight * m.y + pull * prior.mean_y(i)) / (m.weight + pull);
    const double dx = m.x - x;
    const double dy = m.y - y;
    g.alpha = static_cast<float>(m.weight / total);
    g.x = static_cast<float>(x);
    g.y = static_cast<float>(y);
    const double exact = 0.5 * (m.scatter / m.weight + dx * dx + dy * dy);
    g.variance = std::max(static_cast<float>(printed_share(variance, m.weight, total) * exact), variance_floor);
  }
}

double log_prior(const Prior& prior, std::span<const Gaussian> mixture) {
  double sum = 0;
  for (std::size_t i = 0; i < mixture.size(); ++i) sum += prior.log_density(i, mixture[i].x, mixture[i].y);
  return sum;
}

double iterate(const Samples& samples, const Prior& prior, MStep step, int most_iterations, double tolerance,
               std::span<Gaussian> mixture, VarianceStep variance) {
  const double enough = tolerance * samples.total_weight();
  double posterior = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < most_iterations; ++i) {
    const Expectation e = expectation(samples, mixture);
    const double now = e.log_likelihood + log_prior(prior, mixture);
    maximise(e, prior, step, mixture, variance);
    const double gain = now - posterior;
    posterior = now;
    if (std::abs(gain) < enough) break;  // the published step may lower the posterior
  }
  return posterior;
}

void fit_full(const Samples& samples, const Prior& prior, const FitSettings& settings, std::span<const Gaussian> start,
              std::span<FullGaussian> mixture) {
  for (std::size_t i = 0; i < mixture.size(); ++i) {
    const double variance = start[i].variance > variance_floor ? start[i].variance : 0.0F;
    mixture[i] = {.alpha = start[i].alpha, .x = start[i].x, .y = start[i].y, .xx = variance, .yy = variance};
  }
  const double total = samples.total_weight();
  const bool spread = std::ranges::any_of(mixture, [](const FullGaussian& g) { return g.alpha > 0.0 && g.xx > 0.0; });
  if (total <= 0.0 || !spread) return;  // a single normal for each component
  AllSums sums{};
  double posterior = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < settings.most_iterations; ++i) {
    double now = expect(samples, mixture, sums);
    for (std::size_t k = 0; k < mixture.size(); ++k) now += prior.log_density(k, mixture[k].x, mixture[k].y);
    maximise(sums, prior, total, mixture);
    if (now - posterior < settings.tolerance * total) break;
    posterior = now;
  }
}

Gaussian rounded(const FullGaussian& full) {
  return {.alpha = static_cast<float>(full.alpha),
          .x = static_cast<float>(full.x),
          .y = static_cast<float>(full.y),
          .variance = std::max(static_cast<float>(0.5 * (full.xx + full.yy)), variance_floor)};
}

}  // namespace footprint::tan_gmm
