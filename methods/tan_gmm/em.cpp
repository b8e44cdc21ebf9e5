// See em.hpp.
#include "methods/tan_gmm/em.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "methods/tan_gmm/sample_sums.hpp"

namespace footprint::tan_gmm {
namespace {

// The terms of the log densities. A component of no weight is far below any density of a sample: its share is 0.
Terms terms_of(std::span<const Gaussian> mixture) {
  constexpr float never = -1e9F;
  Terms terms;
  for (std::size_t i = 0; i < mixture.size(); ++i) {
    const Gaussian& g = mixture[i];
    terms.x[i] = g.x;
    terms.y[i] = g.y;
    terms.constant[i] = g.alpha > 0.0F ? std::log(g.alpha / (2.0F * std::numbers::pi_v<float> * g.variance)) : never;
    terms.factor[i] = 0.5F / g.variance;
  }
  return terms;
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
  const Sums sums = sums_over(samples, terms_of(mixture), mixture.size());
  Expectation e;
  e.log_likelihood = sums.log_likelihood;
  for (std::size_t i = 0; i < mixture.size(); ++i) {
    Moments& m = e.moments[i];
    m.weight = sums.weight[i];
    if (m.weight <= 0) continue;
    const double dx = sums.dx[i] / m.weight;
    const double dy = sums.dy[i] / m.weight;
    m.x = mixture[i].x + dx;
    m.y = mixture[i].y + dy;
    m.scatter = std::max(sums.square[i] - m.weight * (dx * dx + dy * dy), 0.0);
  }
  return e;
}

void maximise(const Expectation& e, const Prior& prior, MStep step, std::span<Gaussian> mixture) {
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
    g.variance = std::max(static_cast<float>(0.5 * (m.scatter / m.weight + dx * dx + dy * dy)), variance_floor);
  }
}

double log_prior(const Prior& prior, std::span<const Gaussian> mixture) {
  double sum = 0;
  for (std::size_t i = 0; i < mixture.size(); ++i) sum += prior.log_density(i, mixture[i].x, mixture[i].y);
  return sum;
}

double iterate(const Samples& samples, const Prior& prior, MStep step, int most_iterations, double tolerance,
               std::span<Gaussian> mixture) {
  const double enough = tolerance * samples.total_weight();
  double posterior = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < most_iterations; ++i) {
    const Expectation e = expectation(samples, mixture);
    const double now = e.log_likelihood + log_prior(prior, mixture);
    maximise(e, prior, step, mixture);
    const double gain = now - posterior;
    posterior = now;
    if (std::abs(gain) < enough) break;  // the published step may lower the posterior
  }
  return posterior;
}

}  // namespace footprint::tan_gmm
