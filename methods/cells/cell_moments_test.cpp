// Moments of each part against plain sums over texels, at every level and under any weights of a filter.
#include "methods/cells/cell_moments.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "renderer/image/mipmap.hpp"

namespace footprint::cells {
namespace {

constexpr int width = 13;
constexpr int height = 10;
constexpr std::size_t part_count = 3;

struct Map {
  std::vector<PlanePoint> points;
  std::vector<float> shares;

  Map() {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int i = 0; i < width * height; ++i) {
      const double x = unit(random) - 0.5;
      const double y = unit(random) - 0.3;
      points.push_back({.at = {x, y}, .weight = i % 7 == 0 ? 0.0 : 1.0});
      const double a = 0.5 * unit(random);
      const double b = 0.5 * unit(random);
      for (const double share : {a, b, 1.0 - a - b}) shares.push_back(static_cast<float>(share));
    }
  }
};

// Channel j of part k over the whole map, by the definition.
double expected(const Map& map, const std::array<glm::dvec2, most_parts>& centres, std::size_t k, std::size_t j) {
  double sum = 0.0;
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    const double w = map.points[i].weight * static_cast<double>(map.shares[i * part_count + k]);
    const double x = map.points[i].at.x - centres[k].x;
    const double y = map.points[i].at.y - centres[k].y;
    sum += w * std::array{1.0, x, y, x * x, x * y, y * y}[j];
  }
  return sum / (width * height);
}

TEST(CellMoments, TheCoarsestLevelHasTheSumsOverAllTexels) {
  const Map map;
  const auto centres = part_centres(map.points, map.shares, part_count);
  for (int layer = 0; layer < layer_count(part_channels * static_cast<int>(part_count)); ++layer) {
    const Image top = mip_chain(moment_layer(map.points, map.shares, part_count, centres, width, height, layer)).back();
    ASSERT_EQ(top.texel_count(), 1U);
    for (std::size_t c = 0; c < 4; ++c) {
      const std::size_t channel = 4 * static_cast<std::size_t>(layer) + c;
      const std::size_t part = channel / part_channels;
      const double sum = part < part_count ? expected(map, centres, part, channel % part_channels) : 0.0;
      EXPECT_NEAR(top.texels[c], sum, 1e-7) << "part " << part << ", channel " << channel % part_channels;
    }
  }
}

TEST(CellMoments, CentresAreTheMeansOfTheParts) {
  const Map map;
  const auto centres = part_centres(map.points, map.shares, part_count);
  for (std::size_t k = 0; k < part_count; ++k) {
    EXPECT_NEAR(expected(map, centres, k, 1), 0.0, 1e-12);
    EXPECT_NEAR(expected(map, centres, k, 2), 0.0, 1e-12);
  }
  std::vector<float> empty_second;
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    empty_second.push_back(1.0F);
    empty_second.push_back(0.0F);
  }
  const auto of_two = part_centres(map.points, empty_second, 2);
  EXPECT_EQ(of_two[0], of_two[1]) << "a part without texels has the mean of all";
}

// A texel has one normal: its own covariance is zero but for rounding, however small its share.
TEST(CellMoments, OneTexelHasNoSpread) {
  const std::vector<PlanePoint> points{{.at = {0.4, -0.3}, .weight = 1.0}};
  for (const float share : {1.0F, 0.3F, 1e-3F}) {
    const std::vector<float> shares{share, 1.0F - share};
    const std::array<glm::dvec2, most_parts> centres{};
    const Image first = moment_layer(points, shares, 2, centres, 1, 1, 0);
    const double w = first.texels[0];
    const double x = first.texels[1] / w;
    EXPECT_NEAR(x, 0.4, 1e-7);
    EXPECT_NEAR(first.texels[3] / w - x * x, 0.0, 2e-8);
  }
}

TEST(CellMoments, VarianceIsThatOfThePartsOwnTexels) {
  const Map map;
  Image variance(width, height, 1);
  for (std::size_t i = 0; i < variance.texels.size(); ++i) variance.texels[i] = 0.01F * static_cast<float>(i % 5);
  const Image top = mip_chain(variance_layer(map.points, map.shares, part_count, variance, width, height, 0)).back();
  for (std::size_t k = 0; k < part_count; ++k) {
    double sum = 0.0;
    for (std::size_t i = 0; i < map.points.size(); ++i)
      sum += map.points[i].weight * static_cast<double>(map.shares[i * part_count + k]) * 0.01 *
             static_cast<double>(i % 5);
    EXPECT_NEAR(top.texels[k], sum / (width * height), 1e-8);
  }
  EXPECT_EQ(top.texels[3], 0.0F);
  const Image one = variance_layer(map.points, map.shares, part_count, Image(1, 1, 1, 0.5F), width, height, 0);
  EXPECT_NEAR(one.texels[4], 0.5 * map.shares[part_count], 1e-7) << "one texel lies under all";
}

}  // namespace
}  // namespace footprint::cells
