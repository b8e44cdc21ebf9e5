// Which part texels belong to: shares are whole, the same for any threads, and separate what a lobe separates.
#include "methods/cells/partition.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace footprint::cells {
namespace {

// Four kinds of normals in stripes of four texels, each spread by `noise`.
std::vector<PlanePoint> stripes(int width, int height, double noise) {
  constexpr std::array<glm::dvec2, 4> kinds{{{0.3, 0.0}, {-0.3, 0.0}, {0.0, 0.25}, {0.0, -0.25}}};
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0.0, noise);
  std::vector<PlanePoint> points;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double dx = normal(random);
      const double dy = normal(random);
      points.push_back({.at = kinds[static_cast<std::size_t>(x / 4 % 4)] + glm::dvec2(dx, dy), .weight = 1.0});
    }
  }
  return points;
}

// Over all texels, the mean squared distance from the mean of their part, each texel counted with its shares.
double scatter(std::span<const PlanePoint> points, std::span<const float> shares, std::size_t parts) {
  double sum = 0.0;
  for (std::size_t k = 0; k < parts; ++k) {
    double weight = 0.0;
    glm::dvec2 mean(0.0);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double w = shares[i * parts + k];
      weight += w;
      mean += w * points[i].at;
    }
    if (weight <= 0.0) continue;
    mean /= weight;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const glm::dvec2 d = points[i].at - mean;
      sum += static_cast<double>(shares[i * parts + k]) * glm::dot(d, d);
    }
  }
  return sum / static_cast<double>(points.size());
}

TEST(Partition, SharesSumToOne) {
  const std::vector<PlanePoint> points = stripes(37, 21, 0.1);
  for (const int parts : {1, 3, 8}) {
    for (const Labels labels : {Labels::joint, Labels::global}) {
      const auto count = static_cast<std::size_t>(parts);
      const std::vector<float> shares = partition(points, 37, 21, {.parts = parts, .labels = labels}, no_progress);
      ASSERT_EQ(shares.size(), points.size() * count);
      for (std::size_t i = 0; i < points.size(); ++i) {
        double sum = 0.0;
        for (std::size_t k = 0; k < count; ++k) {
          EXPECT_GE(shares[i * count + k], 0.0F);
          sum += shares[i * count + k];
        }
        EXPECT_NEAR(sum, 1.0, 1e-6);
      }
    }
  }
}

TEST(Partition, TellsKindsOfNormalsApart) {
  const std::vector<PlanePoint> points = stripes(64, 64, 0.01);
  for (const Labels labels : {Labels::joint, Labels::global}) {
    const auto shares = partition(points, 64, 64, {.parts = 4, .labels = labels}, no_progress);
    EXPECT_LT(scatter(points, shares, 4), 3e-4) << "that of the noise is 2e-4";
    EXPECT_GT(scatter(points, partition(points, 64, 64, {.parts = 1}, no_progress), 1), 0.05) << "the gate";
  }
}

TEST(Partition, IsTheSameWithOneThread) {
  const std::vector<PlanePoint> points = stripes(64, 48, 0.1);
  const std::vector<float> shares = partition(points, 64, 48, {.parts = 3}, no_progress);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(partition(points, 64, 48, {.parts = 3}, no_progress), shares);
}

TEST(Partition, InvalidTexelsAreOfNoAccount) {
  std::vector<PlanePoint> points = stripes(32, 32, 0.05);
  for (std::size_t i = 0; i < points.size(); i += 3) points[i].weight = 0.0;
  std::vector<PlanePoint> moved = points;
  for (std::size_t i = 0; i < points.size(); i += 3) moved[i].at = {0.9, 0.0};
  const auto shares = partition(points, 32, 32, {.parts = 2}, no_progress);
  const auto others = partition(moved, 32, 32, {.parts = 2}, no_progress);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].weight <= 0.0) continue;
    EXPECT_EQ(shares[2 * i], others[2 * i]);
  }
}

TEST(Partition, NothingValidAndOneNormalAreShared) {
  for (const double weight : {0.0, 1.0}) {
    const std::vector<PlanePoint> points(64, {.at = {0.2, 0.1}, .weight = weight});
    for (const float share : partition(points, 8, 8, {.parts = 4}, no_progress)) EXPECT_TRUE(std::isfinite(share));
  }
}

TEST(Partition, SizesHaveToAgree) {
  const std::vector<PlanePoint> points(12);
  EXPECT_THROW((void)partition(points, 4, 4, {}, no_progress), std::logic_error);
  EXPECT_THROW((void)partition(points, 4, 3, {.parts = 0}, no_progress), std::logic_error);
}

}  // namespace
}  // namespace footprint::cells
