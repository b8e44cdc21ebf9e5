// EM with whole covariances: the samples' own moments, the objective that it climbs, and the cases that divide by
// little.
#include "methods/tan_gmm/em.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace footprint::tan_gmm {
namespace {

// Two streaks that cross: no isotropic pair can separate them.
Samples crossed_streaks(int count) {
  std::mt19937 random(5);
  std::normal_distribution<float> along(0.0F, 0.2F);
  std::normal_distribution<float> across(0.0F, 0.02F);
  Samples samples;
  for (int i = 0; i < count; ++i) {
    const float a = along(random);
    const float b = across(random);
    samples.add(i % 2 == 0 ? a : b, i % 2 == 0 ? b + 0.05F : a, 0.0F, 1.0F);
  }
  return samples;
}

// The mean log-likelihood, from its definition.
double likelihood(const Samples& samples, std::span<const FullGaussian> mixture) {
  double sum = 0.0;
  for (std::size_t j = 0; j < samples.size(); ++j) {
    double density = 0.0;
    for (const FullGaussian& g : mixture) {
      const double a = g.xx + 1e-6;
      const double c = g.yy + 1e-6;
      const double det = a * c - g.xy * g.xy;
      const double dx = samples.x[j] - g.x;
      const double dy = samples.y[j] - g.y;
      density += g.alpha * std::exp(-0.5 * (c * dx * dx - 2.0 * g.xy * dx * dy + a * dy * dy) / det) /
                 (2.0 * std::numbers::pi * std::sqrt(det));
    }
    sum += std::log(density);
  }
  return sum / static_cast<double>(samples.size());
}

TEST(FullCovariance, OneComponentHasTheSamplesOwnMoments) {
  const Samples samples = crossed_streaks(400);
  double x = 0;
  double y = 0;
  double xx = 0;
  double xy = 0;
  for (std::size_t j = 0; j < samples.size(); ++j) {
    x += samples.x[j] / 400.0;
    y += samples.y[j] / 400.0;
  }
  for (std::size_t j = 0; j < samples.size(); ++j) {
    xx += (samples.x[j] - x) * (samples.x[j] - x) / 400.0;
    xy += (samples.x[j] - x) * (samples.y[j] - y) / 400.0;
  }
  const std::array<Gaussian, 1> start{{{.alpha = 1.0F, .x = 0.3F, .y = -0.2F, .variance = 0.1F}}};
  std::array<FullGaussian, 1> mixture{};
  fit_full(samples, Prior(0.0), {.components = 1}, start, mixture);
  EXPECT_NEAR(mixture[0].x, x, 1e-9);
  EXPECT_NEAR(mixture[0].y, y, 1e-9);
  EXPECT_NEAR(mixture[0].xx, xx, 1e-9);
  EXPECT_NEAR(mixture[0].xy, xy, 1e-9);
}

TEST(FullCovariance, TellsCrossedStreaksApart) {
  const Samples samples = crossed_streaks(600);
  std::array<Gaussian, 2> start{
      {{.alpha = 0.5F, .x = 0.05F, .variance = 0.02F}, {.alpha = 0.5F, .x = -0.05F, .y = 0.05F, .variance = 0.02F}}};
  iterate(samples, Prior(0.0), MStep::exact, 40, 1e-6, start);
  std::array<FullGaussian, 2> round{};
  for (std::size_t i = 0; i < 2; ++i)
    round[i] = {start[i].alpha, start[i].x, start[i].y, start[i].variance, 0.0, start[i].variance};
  std::array<FullGaussian, 2> mixture{};
  const FitSettings settings{.components = 2, .most_iterations = 100, .tolerance = 1e-7};
  fit_full(samples, Prior(0.0), settings, start, mixture);
  EXPECT_GT(likelihood(samples, mixture), likelihood(samples, round) + 0.3);
  EXPECT_NEAR(mixture[0].alpha + mixture[1].alpha, 1.0, 1e-12);
}

// More steps never lower what EM climbs.
TEST(FullCovariance, StepsDoNotLowerTheLikelihood) {
  const Samples samples = crossed_streaks(200);
  const std::array<Gaussian, 2> start{
      {{.alpha = 0.6F, .x = 0.1F, .variance = 0.03F}, {.alpha = 0.4F, .x = -0.1F, .variance = 0.01F}}};
  double before = -1e9;
  for (int steps = 1; steps < 20; ++steps) {
    std::array<FullGaussian, 2> mixture{};
    fit_full(samples, Prior(0.0), {.components = 2, .most_iterations = steps, .tolerance = -1.0}, start, mixture);
    const double now = likelihood(samples, mixture);
    EXPECT_GE(now, before - 1e-4) << "but for the floor of the variance";
    before = now;
  }
}

// A prior of great weight fixes the mean; one of none leaves it.
TEST(FullCovariance, ThePriorDrawsTheMean) {
  const Samples samples = crossed_streaks(100);
  const std::array<Gaussian, 1> start{{{.alpha = 1.0F, .variance = 0.02F}}};
  const std::array<Gaussian, 1> neighbour{{{.alpha = 1.0F, .x = 0.3F, .y = 0.1F}}};
  std::array<FullGaussian, 1> fixed{};
  Prior prior(1e6);
  prior.add(neighbour);
  fit_full(samples, prior, {.components = 1}, start, fixed);
  EXPECT_NEAR(fixed[0].x, 0.3, 0.01);
  EXPECT_NEAR(fixed[0].y, 0.1, 0.01);
  std::array<FullGaussian, 1> loose{};
  fit_full(samples, Prior(0.0), {.components = 1}, start, loose);
  EXPECT_LT(std::abs(loose[0].x), 0.05);
}

TEST(FullCovariance, NoSamplesAndOneNormalStayFinite) {
  Samples one;
  one.add(0.4F, -0.3F, 0.0F, 1.0F);
  one.add(0.4F, -0.3F, 0.0F, 2.0F);
  const std::array<Gaussian, 2> start{{{.alpha = 1.0F, .x = 0.4F, .y = -0.3F, .variance = 0.01F}, {}}};
  for (const Samples& samples : {Samples{}, one}) {
    std::array<FullGaussian, 2> mixture{};
    fit_full(samples, Prior(1.0), {.components = 2}, start, mixture);
    for (const FullGaussian& g : mixture) {
      EXPECT_TRUE(std::isfinite(g.alpha) && std::isfinite(g.x) && std::isfinite(g.xy));
      EXPECT_GE(g.xx, 0.0);
      EXPECT_GE(rounded(g).variance, variance_floor);
    }
    EXPECT_EQ(mixture[1].alpha, 0.0);
  }
}

}  // namespace
}  // namespace footprint::tan_gmm
