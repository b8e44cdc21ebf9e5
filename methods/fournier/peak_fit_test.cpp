// Fits of peaks to targets that are known.
#include "methods/fournier/peaks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace footprint::fournier {
namespace {

Eigen::Vector3d tilted(double x, double y) { return Eigen::Vector3d(x, y, std::sqrt(1.0 - x * x - y * y)); }

// Peaks that lie a few of their own widths apart, about the base lobe of exponent 256.
constexpr double base = 1.0 / 256.0;
const std::vector<Peak> known{{0.4, tilted(0.0, 0.0), 0.004},
                              {0.25, tilted(0.6, 0.1), 0.001},
                              {0.2, tilted(-0.4, 0.5), 0.008},
                              {0.15, tilted(-0.3, -0.6), 0.002}};

TEST(PeakFit, RecoversAKnownMixture) {
  std::vector<Peak> start = known;
  for (Peak& peak : start) {
    peak.axis = (peak.axis + Eigen::Vector3d(0.05, -0.04, 0.0)).normalized();
    peak.spread *= 2.5;
    peak.weight = 0.25;
  }
  const Fit fit = fit_peaks(known, start, base);
  EXPECT_TRUE(fit.converged);
  EXPECT_GT(fit.start_error, 0.2);
  EXPECT_LT(fit.error, 1e-3);
  ASSERT_EQ(fit.peaks.size(), known.size());
  for (std::size_t i = 0; i < known.size(); ++i) {
    EXPECT_NEAR(fit.peaks[i].weight, known[i].weight, 1e-3);
    EXPECT_NEAR(fit.peaks[i].spread, known[i].spread, 1e-4);
    EXPECT_LT((fit.peaks[i].axis - known[i].axis).norm(), 1e-3);
  }
}

TEST(PeakFit, StopsAfterTheEvaluationsThatItIsGiven) {
  std::vector<Peak> start = known;
  for (Peak& peak : start) peak.spread *= 2.5;
  const Fit two = fit_peaks(known, start, base, 2);
  EXPECT_FALSE(two.converged);
  EXPECT_LE(two.error, two.start_error);
  EXPECT_GT(two.error, 10.0 * fit_peaks(known, start, base).error);
}

std::vector<Peak> random_target(std::uint32_t seed, int count, double most_tilt) {
  std::mt19937 random(seed);
  const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
  std::vector<Peak> target;
  for (int i = 0; i < count; ++i) {
    const double x = (uniform() - 0.5) * 1.4 * most_tilt;
    const double y = (uniform() - 0.5) * 1.4 * most_tilt;
    target.push_back({uniform(), tilted(x, y), 0.0});
  }
  return target;
}

std::vector<Peak> start_of(const std::vector<Peak>& target, std::size_t count) {
  std::vector<Moments> sets;
  sets.reserve(target.size());
  for (const Peak& peak : target) sets.push_back(moments_of(peak));
  return merged_peaks(sets, count);
}

TEST(PeakFit, IsNeverWorseThanTheStart) {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    const std::vector<Peak> target = random_target(seed, 8 + static_cast<int>(seed), 0.2 + 0.012 * seed);
    for (const double variance : {0.25, 0.02, 1e-3, 1e-5}) {
      for (const std::size_t count : {1U, 4U, 7U}) {
        const Fit fit = fit_peaks(target, start_of(target, count), variance);
        EXPECT_LE(fit.error, fit.start_error);
        double weight = 0, expected = 0;
        for (const Peak& peak : target) expected += peak.weight;
        for (const Peak& peak : fit.peaks) {
          EXPECT_TRUE(peak.weight >= 0.0 && peak.spread >= 0.0 && std::isfinite(peak.spread));
          EXPECT_NEAR(peak.axis.norm(), 1.0, 1e-12);
          weight += peak.weight;
        }
        EXPECT_NEAR(weight, expected, 1e-9 * expected);
      }
    }
  }
}

// Normals in four heaps, their own heaviest ones the seeds: each heap becomes a peak with its weight and mean.
TEST(ClusteredPeaks, AreTheHeapsOfTheNormals) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-0.03, 0.03);
  std::vector<Peak> normals;
  for (const Peak& heap : known) {
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector3d axis = (heap.axis + Eigen::Vector3d(unit(random), unit(random), 0.0)).normalized();
      normals.push_back({heap.weight / 20.0 * (i == 7 ? 1.01 : 1.0), axis, 0.0});
    }
  }
  const std::vector<Peak> peaks = clustered_peaks(normals, known.size(), 0.2);
  ASSERT_EQ(peaks.size(), known.size());
  for (std::size_t i = 0; i < known.size(); ++i) {
    EXPECT_NEAR(peaks[i].weight, known[i].weight, 1e-3);
    EXPECT_LT((peaks[i].axis - known[i].axis).norm(), 0.02);
    EXPECT_GT(peaks[i].spread, 0.0);
  }
}

// Where no normals lie so far apart, the heaviest of the others are seeds too; nothing of the weight is lost.
TEST(ClusteredPeaks, TakeNearNormalsWhereThereAreNoOthers) {
  const std::vector<Peak> normals{{0.1, tilted(0.0, 0.0), 0.0},
                                  {0.5, tilted(0.01, 0.0), 0.0},
                                  {0.1, tilted(0.0, 0.01), 0.0},
                                  {0.3, tilted(0.01, 0.01), 0.0}};
  const std::vector<Peak> peaks = clustered_peaks(normals, 3, 0.5);
  ASSERT_EQ(peaks.size(), 3U);
  double total = 0.0;
  for (const Peak& peak : peaks) total += peak.weight;
  EXPECT_NEAR(total, 1.0, 1e-12);
  EXPECT_GE(peaks[0].weight, 0.5);
}

}  // namespace
}  // namespace footprint::fournier
