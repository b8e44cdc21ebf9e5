// EM on one texel, against sums and searches that share no code with it.
#include "methods/tan_gmm/em.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include "methods/tan_gmm/mixture_chain.hpp"

namespace footprint::tan_gmm {
namespace {

// A texel with its neighbours, as numbers.
struct Problem {
  Samples samples;
  std::vector<std::vector<Gaussian>> neighbours;
  std::vector<Gaussian> mixture;
  double c = 1.0;

  [[nodiscard]] Prior prior() const {
    Prior prior(c);
    for (const auto& neighbour : neighbours) prior.add(neighbour);
    return prior;
  }
};

std::vector<Gaussian> random_mixture(std::mt19937& random, std::size_t count) {
  std::uniform_real_distribution<float> coordinate(-0.6F, 0.6F);
  std::uniform_real_distribution<float> share(0.1F, 1.0F);
  std::vector<Gaussian> mixture(count);
  float total = 0;
  for (Gaussian& g : mixture) {
    g = {.alpha = share(random), .x = coordinate(random), .y = coordinate(random), .variance = 0.05F * share(random)};
    total += g.alpha;
  }
  for (Gaussian& g : mixture) g.alpha /= total;
  return mixture;
}

Problem random_problem(std::mt19937& random, std::size_t samples, std::size_t components) {
  Problem p;
  std::normal_distribution<float> noise(0.0F, 0.1F);
  for (std::size_t j = 0; j < samples; ++j) {
    const float side = j % 2 == 0 ? 0.3F : -0.3F;
    p.samples.add(side + noise(random), noise(random), 0.0F, 1.0F);
  }
  for (int k = 0; k < 5; ++k) p.neighbours.push_back(random_mixture(random, components));
  p.mixture = random_mixture(random, components);
  return p;
}

double log_gaussian(double x, double y, double mean_x, double mean_y, double variance) {
  const double d2 = (x - mean_x) * (x - mean_x) + (y - mean_y) * (y - mean_y);
  return -std::log(2.0 * std::numbers::pi * variance) - d2 / (2.0 * variance);
}

double log_sum(const std::vector<double>& terms) {
  const double peak = *std::ranges::max_element(terms);
  return peak + std::log(std::accumulate(terms.begin(), terms.end(), 0.0,
                                         [&](double sum, double term) { return sum + std::exp(term - peak); }));
}

std::vector<double> log_terms(const Problem& p, std::size_t j) {
  std::vector<double> terms;
  for (const Gaussian& g : p.mixture) {
    terms.push_back(std::log(std::max<double>(g.alpha, 1e-300)) +
                    log_gaussian(p.samples.x[j], p.samples.y[j], g.x, g.y, g.variance));
  }
  return terms;
}

// log P(X | Theta) + log P(Theta | neighbours), term by term as Tan 2005, section 4.1 has it, with the exponent c.
double log_posterior(const Problem& p) {
  double sum = 0;
  for (std::size_t j = 0; j < p.samples.size(); ++j) sum += p.samples.weight[j] * log_sum(log_terms(p, j));
  for (const auto& neighbour : p.neighbours) {
    for (std::size_t i = 0; i < neighbour.size(); ++i) {
      const double dx = neighbour[i].x - p.mixture[i].x;
      const double dy = neighbour[i].y - p.mixture[i].y;
      sum -= p.c * neighbour[i].alpha * (dx * dx + dy * dy);
    }
  }
  return sum;
}

std::vector<std::vector<double>> responsibilities(const Problem& p) {
  std::vector<std::vector<double>> z;
  for (std::size_t j = 0; j < p.samples.size(); ++j) {
    std::vector<double> terms = log_terms(p, j);
    const double total = log_sum(terms);
    for (double& term : terms) term = std::exp(term - total);
    z.push_back(terms);
  }
  return z;
}

// The greatest value of a function of three numbers by a compass search: no derivative, no formula.
template <typename Function>
std::array<double, 3> maximum(Function f, std::array<double, 3> at) {
  double best = f(at);
  for (double step = 0.1; step > 1e-10;) {
    bool moved = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const double sign : {-1.0, 1.0}) {
        std::array<double, 3> next = at;
        next[axis] += sign * step;
        if (const double value = f(next); value > best) {
          best = value;
          at = next;
          moved = true;
        }
      }
    }
    if (!moved) step *= 0.5;
  }
  return at;
}

// The expected log posterior Q of one component as a function of mu and log sigma^2, with fixed responsibilities.
std::array<double, 3> maximum_of_q(const Problem& p, const std::vector<std::vector<double>>& z, std::size_t i) {
  const auto q = [&](const std::array<double, 3>& at) {
    double sum = 0;
    for (std::size_t j = 0; j < p.samples.size(); ++j)
      sum += z[j][i] * log_gaussian(p.samples.x[j], p.samples.y[j], at[0], at[1], std::exp(at[2]));
    for (const auto& neighbour : p.neighbours) {
      const double dx = neighbour[i].x - at[0];
      const double dy = neighbour[i].y - at[1];
      sum -= p.c * neighbour[i].alpha * (dx * dx + dy * dy);
    }
    return sum;
  };
  const std::array<double, 3> at = maximum(q, {0.0, 0.0, std::log(0.01)});
  return {at[0], at[1], std::exp(at[2])};
}

TEST(TanEm, ExpectationMeetsTheSumOverSamples) {
  std::mt19937 random(1);
  const Problem p = random_problem(random, 600, 4);  // more than one block
  const Expectation e = expectation(p.samples, p.mixture);
  const auto z = responsibilities(p);
  double likelihood = 0;
  for (std::size_t j = 0; j < p.samples.size(); ++j) likelihood += log_sum(log_terms(p, j));
  EXPECT_NEAR(e.log_likelihood, likelihood, 1e-3);
  for (std::size_t i = 0; i < 4; ++i) {
    double weight = 0;
    double x = 0;
    double y = 0;
    for (std::size_t j = 0; j < z.size(); ++j) {
      weight += z[j][i];
      x += z[j][i] * p.samples.x[j];
      y += z[j][i] * p.samples.y[j];
    }
    double scatter = 0;
    for (std::size_t j = 0; j < z.size(); ++j) {
      const double dx = p.samples.x[j] - x / weight;
      const double dy = p.samples.y[j] - y / weight;
      scatter += z[j][i] * (dx * dx + dy * dy);
    }
    EXPECT_NEAR(e.moments[i].weight / weight, 1.0, 2e-5);
    EXPECT_NEAR(e.moments[i].x, x / weight, 2e-6);
    EXPECT_NEAR(e.moments[i].y, y / weight, 2e-6);
    EXPECT_NEAR(e.moments[i].scatter / scatter, 1.0, 5e-5);
  }
}

// mu and sigma^2 depend on one another, so that a step is repeated, with fixed responsibilities, until neither moves.
TEST(TanEm, ExactMStepIsTheMaximumOfQ) {
  std::mt19937 random(2);
  Problem p = random_problem(random, 40, 2);
  const auto z = responsibilities(p);
  const Expectation e = expectation(p.samples, p.mixture);
  std::vector<Gaussian> stepped = p.mixture;
  for (int i = 0; i < 200; ++i) maximise(e, p.prior(), MStep::exact, stepped);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto [x, y, variance] = maximum_of_q(p, z, i);
    EXPECT_NEAR(stepped[i].x, x, 2e-6);
    EXPECT_NEAR(stepped[i].y, y, 2e-6);
    EXPECT_NEAR(stepped[i].variance / variance, 1.0, 2e-5);
  }
  EXPECT_NEAR(stepped[0].alpha + stepped[1].alpha, 1.0F, 1e-6F);
}

// The paper's step weighs the prior by c; at 2 sigma^2 = 1 the two are one.
TEST(TanEm, PublishedMStepHasItsOwnPrior) {
  std::mt19937 random(3);
  const Problem p = random_problem(random, 40, 2);
  const Expectation e = expectation(p.samples, p.mixture);
  std::vector<Gaussian> published = p.mixture;
  maximise(e, p.prior(), MStep::published, published);
  const Moments& m = e.moments[0];
  double pull = 0;
  double x = m.weight * m.x;
  for (const auto& neighbour : p.neighbours) {
    pull += neighbour[0].alpha;
    x += static_cast<double>(neighbour[0].alpha) * neighbour[0].x;
  }
  EXPECT_NEAR(published[0].x, x / (m.weight + pull), 1e-6);
  std::vector<Gaussian> wide = p.mixture;
  for (Gaussian& g : wide) g.variance = 0.5F;
  std::vector<Gaussian> other = wide;
  maximise(e, p.prior(), MStep::exact, wide);
  maximise(e, p.prior(), MStep::published, other);
  EXPECT_EQ(wide, other);
}

// The printed variance of a component with N of M samples is the exact one over M, or times N / M; its floor stays.
TEST(TanEm, PublishedVarianceIsOutOfScale) {
  std::mt19937 random(3);
  const Problem p = random_problem(random, 40, 2);
  const Expectation e = expectation(p.samples, p.mixture);
  const auto stepped = [&](VarianceStep variance) {
    std::vector<Gaussian> mixture = p.mixture;
    maximise(e, p.prior(), MStep::exact, mixture, variance);
    return mixture;
  };
  const std::vector<Gaussian> exact = stepped(VarianceStep::exact);
  const std::vector<Gaussian> published = stepped(VarianceStep::published);
  const std::vector<Gaussian> share = stepped(VarianceStep::published_share);
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_GT(exact[i].variance, 40.0F * variance_floor);
    EXPECT_NEAR(published[i].variance * 40.0F / exact[i].variance, 1.0F, 1e-5F);
    EXPECT_NEAR(share[i].variance / (exact[i].alpha * exact[i].variance), 1.0F, 1e-5F);
    EXPECT_EQ(published[i].x, exact[i].x);
  }
  std::vector<Gaussian> mixture = p.mixture;
  iterate(p.samples, p.prior(), MStep::exact, 40, 1e-4, mixture, VarianceStep::published);
  for (const Gaussian& g : mixture) EXPECT_GE(g.variance, variance_floor);
}

// 200 random small problems: the exact step never lowers the posterior, the published one does in most of them.
TEST(TanEm, ExactStepNeverLowersThePosterior) {
  int lowered_by_published = 0;
  for (int index = 0; index < 200; ++index) {
    std::mt19937 random(100U + static_cast<unsigned>(index));
    constexpr std::array<std::size_t, 3> sizes{4, 16, 64};
    const Problem start = random_problem(random, sizes[static_cast<std::size_t>(index) % 3], 2 + index % 3);
    for (const MStep step : {MStep::exact, MStep::published}) {
      Problem p = start;
      bool lowered = false;
      for (int i = 0; i < 30; ++i) {
        const double before = log_posterior(p);
        maximise(expectation(p.samples, p.mixture), p.prior(), step, p.mixture);
        const double after = log_posterior(p);
        const double rounding = 1e-5 * (1.0 + std::abs(before));  // parameters and responsibilities are 32-bit
        lowered = lowered || after < before - rounding;
      }
      if (step == MStep::exact) {
        EXPECT_FALSE(lowered) << "problem " << index;
      }
      if (step == MStep::published && lowered) ++lowered_by_published;
    }
  }
  EXPECT_GT(lowered_by_published, 50);
}

void expect_sound(std::span<const Gaussian> mixture) {
  double total = 0;
  for (const Gaussian& g : mixture) {
    EXPECT_TRUE(std::isfinite(g.x) && std::isfinite(g.y) && std::isfinite(g.variance)) << g.x << " " << g.variance;
    EXPECT_GE(g.variance, variance_floor);
    EXPECT_GE(g.alpha, 0.0F);
    total += g.alpha;
  }
  EXPECT_NEAR(total, 1.0, 1e-6);
}

// With as many Gaussians as samples, or more, they would shrink without end.
TEST(TanEm, FewOrEqualSamplesStayFinite) {
  for (const std::size_t count : {1U, 2U, 4U, 7U}) {
    for (const bool equal : {false, true}) {
      for (const Start start : {Start::clusters, Start::dense_seed}) {
        Samples samples;
        for (std::size_t j = 0; j < count; ++j) samples.add(equal ? 0.25F : 0.1F * static_cast<float>(j), 0.1F, 0, 1);
        std::array<Gaussian, 4> mixture{};
        fit_texel(samples, Prior(1.0), {}, {.components = 4, .start = start}, mixture);
        expect_sound(mixture);
      }
    }
  }
}

// exp(-1 / (2 * 1e-6)) is 0 in any float: without the log-sum-exp nothing would be left to divide by.
TEST(TanEm, AFarSampleIsShared) {
  Samples samples;
  samples.add(1.0F, 0.0F, 0.0F, 1.0F);
  const std::array<Gaussian, 2> mixture{{{0.5F, 0.0F, 0.0F, 1e-6F}, {0.5F, 0.0F, 0.1F, 1e-6F}}};
  const Expectation e = expectation(samples, mixture);
  EXPECT_NEAR(e.moments[0].weight + e.moments[1].weight, 1.0, 1e-6);
  EXPECT_TRUE(std::isfinite(e.log_likelihood));
}

TEST(TanEm, AnEmptyComponentKeepsItsPlace) {
  Samples samples;
  for (int j = 0; j < 8; ++j) samples.add(0.01F * static_cast<float>(j), 0.0F, 0.0F, 1.0F);
  std::array<Gaussian, 3> mixture{{{0.5F, 0.0F, 0.0F, 0.01F}, {0.5F, 0.9F, 0.0F, 1e-4F}, {0.0F, 0.1F, 0.2F, 0.3F}}};
  maximise(expectation(samples, mixture), Prior(1.0), MStep::exact, mixture);
  expect_sound(mixture);
  EXPECT_EQ(mixture[1].alpha, 0.0F);
  EXPECT_EQ(mixture[1].x, 0.9F);
  EXPECT_EQ(mixture[2], (Gaussian{0.0F, 0.1F, 0.2F, 0.3F}));
}

TEST(TanEm, NoSamplesNoWeight) {
  std::array<Gaussian, 3> mixture{};
  fit_texel({}, Prior(1.0), {}, {.components = 3}, mixture);
  for (const Gaussian& g : mixture) EXPECT_EQ(g.alpha, 0.0F);
}

// Half of the samples one normal, half spread widely: hard case of clusters alone, which cut the spread in pieces.
TEST(TanEm, ADenseSeedFindsTheSpike) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> coordinate(-0.65F, 0.65F);
  Samples samples;
  for (int j = 0; j < 1000; ++j) {
    samples.add(0.05F, 0.02F, 0.0F, 1.0F);
    samples.add(coordinate(random), coordinate(random), 0.0F, 1.0F);
  }
  std::array<Gaussian, 4> mixture{};
  fit_texel(samples, Prior(1.0), {}, {.components = 4, .start = Start::dense_seed}, mixture);
  const Gaussian spike = *std::ranges::min_element(mixture, {}, &Gaussian::variance);
  EXPECT_NEAR(spike.alpha, 0.5F, 0.02F);
  EXPECT_NEAR(spike.x, 0.05F, 1e-3F);
  EXPECT_LT(spike.variance, 1e-4F);
}

// Against all orders, one after the other.
TEST(TanEm, OrderMatchesThePriorBest) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    const Problem p = random_problem(random, 4, 5);
    const Prior prior = p.prior();
    std::vector<Gaussian> matched = p.mixture;
    match_order(prior, matched);
    std::array<std::size_t, 5> order{0, 1, 2, 3, 4};
    double best = -1e30;
    do {
      double sum = 0;
      for (std::size_t i = 0; i < 5; ++i) sum += prior.log_density(i, p.mixture[order[i]].x, p.mixture[order[i]].y);
      best = std::max(best, sum);
    } while (std::ranges::next_permutation(order).found);
    EXPECT_NEAR(log_prior(prior, matched), best, 1e-9);
  }
}

}  // namespace
}  // namespace footprint::tan_gmm
