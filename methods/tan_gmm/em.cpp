// The E-step, the M-step with the prior, and their iteration. Isotropic Gaussians skip components without weight.
// Gaussians with a full covariance are fitted sample by sample in 64 bits: a reference for isotropic ones, not a fast
// method.
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
    const double dx = static_cast<double>(samples.x[j]) - terms.x[0];
    const double dy = static_cast<double>(samples.y[j]) - terms.y[0];
    sums.weight[0] += weight;
    sums.dx[0] += weight * dx;
    sums.dy[0] += weight * dy;
    sums.square[0] += weight * (dx * dx + dy * dy + samples.spread[j]);
  }
  sums.log_likelihood = terms.constant[0] * sums.weight[0] - terms.factor[0] * sums.square[0];
  return sums;
}

// Sums over samples of weight times responsibility, about the component's mean before the step.
struct FullSums {
  double weight = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
};

// log(alpha g) as constant - (xx dx^2 + 2 xy dx dy + yy dy^2) / 2.
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
};

class FullStep {
 public:
  explicit FullStep(std::span<FullGaussian> mixture) : mixture_(mixture) {}

  // The E-step; returns the log-likelihood. A sample with a spread contributes the mean log density of its points.
  double expect(const Samples& samples) {
    std::array<std::size_t, most_components> index{};
    std::size_t count = 0;
    std::array<double, most_components> log_share{};
    densities_.clear();
    for (std::size_t i = 0; i < mixture_.size(); ++i) {
      sums_[i] = {};
      if (mixture_[i].alpha <= 0.0) continue;
      index[count++] = i;
      densities_.emplace_back(mixture_[i]);
    }
    double likelihood = 0.0;
    for (std::size_t j = 0; j < samples.size() && count > 0; ++j) {
      const double spread = 0.5 * static_cast<double>(samples.spread[j]);  // per axis
      double most = -std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < count; ++k) {
        const FullGaussian& g = mixture_[index[k]];
        const LogDensity& d = densities_[k];
        const double dx = static_cast<double>(samples.x[j]) - g.x;
        const double dy = static_cast<double>(samples.y[j]) - g.y;
        log_share[k] = d.constant - 0.5 * (d.xx * (dx * dx + spread) + d.yy * (dy * dy + spread)) - d.xy * dx * dy;
        most = std::max(most, log_share[k]);
      }
      double total = 0.0;
      for (std::size_t k = 0; k < count; ++k) total += log_share[k] = std::exp(log_share[k] - most);
      likelihood += static_cast<double>(samples.weight[j]) * (most + std::log(total));
      for (std::size_t k = 0; k < count; ++k) {
        const FullGaussian& g = mixture_[index[k]];
        add(sums_[index[k]], static_cast<double>(samples.weight[j]) * log_share[k] / total,
            static_cast<double>(samples.x[j]) - g.x, static_cast<double>(samples.y[j]) - g.y, spread);
      }
    }
    return likelihood;
  }

  void maximise(const Prior& prior, double total) {
    for (std::size_t i = 0; i < mixture_.size(); ++i) {
      FullGaussian& g = mixture_[i];
      const FullSums& s = sums_[i];
      if (s.weight <= 1e-12 * total) {
        g.alpha = 0.0;
        continue;
      }
      const double x = s.x / s.weight;  // of the samples, relative to the mean before the step
      const double y = s.y / s.weight;
      const double pull = 2.0 * prior.weight(i);
      // (N I + pull S) d = N m + pull S (mu_0 - mu).
      const double to_x = prior.mean_x(i) - g.x;
      const double to_y = prior.mean_y(i) - g.y;
      const double a = s.weight + pull * g.xx;
      const double b = pull * g.xy;
      const double c = s.weight + pull * g.yy;
      const double right_x = s.x + pull * (g.xx * to_x + g.xy * to_y);
      const double right_y = s.y + pull * (g.xy * to_x + g.yy * to_y);
      const double determinant = a * c - b * b;
      const double dx = (c * right_x - b * right_y) / determinant;
      const double dy = (a * right_y - b * right_x) / determinant;
      g.alpha = s.weight / total;
      g.x += dx;
      g.y += dy;
      // About the new mean: the scatter about the samples' mean plus the squared distance between the two means.
      g.xx = std::max(s.xx / s.weight - x * x, 0.0) + (x - dx) * (x - dx);
      g.yy = std::max(s.yy / s.weight - y * y, 0.0) + (y - dy) * (y - dy);
      const double most = std::sqrt(g.xx * g.yy);
      g.xy = std::clamp(s.xy / s.weight - x * y + (x - dx) * (y - dy), -most, most);
    }
  }

 private:
  static void add(FullSums& sums, double w, double dx, double dy, double spread) {
    sums.weight += w;
    sums.x += w * dx;
    sums.y += w * dy;
    sums.xx += w * (dx * dx + spread);
    sums.xy += w * dx * dy;
    sums.yy += w * (dy * dy + spread);
  }

  std::span<FullGaussian> mixture_;
  std::vector<LogDensity> densities_;
  std::array<FullSums, most_components> sums_{};
};

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
  FullStep step(mixture);
  double posterior = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < settings.most_iterations; ++i) {
    double now = step.expect(samples);
    for (std::size_t k = 0; k < mixture.size(); ++k) now += prior.log_density(k, mixture[k].x, mixture[k].y);
    step.maximise(prior, total);
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
