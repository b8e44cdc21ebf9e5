// See em.hpp.
#include "methods/tan_gmm/em.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace footprint::tan_gmm {
namespace {

// Samples are taken in blocks that stay in the first cache; their sums are kept in double.
constexpr Eigen::Index block_size = 256;
using Column = Eigen::Array<float, Eigen::Dynamic, 1, Eigen::ColMajor, block_size, 1>;
using Table = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, block_size, most_components>;
using Points = Eigen::Map<const Eigen::ArrayXf>;

// e^-60 is no responsibility to speak of; far below it products are subnormal, which processors take a hundred times as
// long for.
constexpr float least_exponent = -60.0F;

// log(alpha / (2 pi sigma^2)) - r^2 / (2 sigma^2), the terms of a component's log density.
struct LogDensity {
  float constant, factor;

  explicit LogDensity(const Gaussian& g)
      : constant(g.alpha > 0.0F ? std::log(g.alpha / (2.0F * std::numbers::pi_v<float> * g.variance)) : never),
        factor(0.5F / g.variance) {}

  static constexpr float never = -1e9F;  // far below any density of a sample: its responsibility is 0
};

// Sums about the component's mean before the step; about its own mean they would need a second pass.
struct Sums {
  double weight = 0, dx = 0, dy = 0, square = 0;
};

void add_block(const Points& x, const Points& y, const Points& spread, const Points& weight,
               std::span<const Gaussian> mixture, std::span<Sums> sums, double& log_likelihood) {
  const auto count = static_cast<Eigen::Index>(mixture.size());
  Table square(x.size(), count);
  Table share(x.size(), count);
  Column peak = Column::Constant(x.size(), std::numeric_limits<float>::lowest());
  for (Eigen::Index i = 0; i < count; ++i) {
    const Gaussian& g = mixture[static_cast<std::size_t>(i)];
    const LogDensity density(g);
    square.col(i) = (x - g.x).square() + (y - g.y).square() + spread;
    share.col(i) = density.constant - density.factor * square.col(i);
    peak = peak.max(share.col(i));
  }
  Column total = Column::Zero(x.size());
  for (Eigen::Index i = 0; i < count; ++i) {
    share.col(i) = (share.col(i) - peak).max(least_exponent).exp();
    total += share.col(i);
  }
  log_likelihood += static_cast<double>((weight * (peak + total.log())).sum());
  total = weight / total;
  for (Eigen::Index i = 0; i < count; ++i) {
    const Gaussian& g = mixture[static_cast<std::size_t>(i)];
    Sums& sum = sums[static_cast<std::size_t>(i)];
    share.col(i) *= total;
    sum.weight += static_cast<double>(share.col(i).sum());
    sum.dx += static_cast<double>((share.col(i) * (x - g.x)).sum());
    sum.dy += static_cast<double>((share.col(i) * (y - g.y)).sum());
    sum.square += static_cast<double>((share.col(i) * square.col(i)).sum());
  }
}

}  // namespace

void Prior::add(std::span<const Gaussian> neighbour) {
  for (std::size_t i = 0; i < neighbour.size(); ++i) {
    const double alpha = neighbour[i].alpha;
    weight_[i] += alpha;
    x_[i] += alpha * neighbour[i].x;
    y_[i] += alpha * neighbour[i].y;
  }
}

double Prior::log_density(std::size_t i, double x, double y) const {
  const double dx = x - mean_x(i);
  const double dy = y - mean_y(i);
  return -weight(i) * (dx * dx + dy * dy);
}

Expectation expectation(const Samples& samples, std::span<const Gaussian> mixture) {
  std::array<Sums, most_components> sums{};
  Expectation e;
  const auto size = static_cast<Eigen::Index>(samples.size());
  for (Eigen::Index begin = 0; begin < size; begin += block_size) {
    const Eigen::Index count = std::min(block_size, size - begin);
    add_block(Points(samples.x.data() + begin, count), Points(samples.y.data() + begin, count),
              Points(samples.spread.data() + begin, count), Points(samples.weight.data() + begin, count), mixture, sums,
              e.log_likelihood);
  }
  for (std::size_t i = 0; i < mixture.size(); ++i) {
    Moments& m = e.moments[i];
    m.weight = sums[i].weight;
    if (m.weight <= 0) continue;
    const double dx = sums[i].dx / m.weight;
    const double dy = sums[i].dy / m.weight;
    m.x = mixture[i].x + dx;
    m.y = mixture[i].y + dy;
    m.scatter = std::max(sums[i].square - m.weight * (dx * dx + dy * dy), 0.0);
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
