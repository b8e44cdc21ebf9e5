// The E-step over the components that have weight, the M-step with the prior, and the iteration of both.
#include "methods/tan_gmm/em.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "methods/tan_gmm/sample_sums.hpp"

namespace footprint::tan_gmm {
namespace {

// The components that have weight, in their order; the others have no share in any sample.
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

// A component alone takes every sample whole.
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
