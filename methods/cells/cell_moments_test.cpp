// Moments of each part against plain sums over texels, at every level and under any weights of a filter.
#include "methods/cells/partition.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

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

// Part k over the whole map, by the definition: w, w x, w y, w x^2, w x y, w y^2 along the frame's axes.
std::array<double, 6> expected(const Map& map, const PartFrame& frame, std::size_t k) {
  std::array<double, 6> sums{};
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    const double w = map.points[i].weight * static_cast<double>(map.shares[i * part_count + k]);
    const glm::dvec2 d = map.points[i].at - frame.centre;
    const double x = d.x * frame.axis.x + d.y * frame.axis.y;
    const double y = d.y * frame.axis.x - d.x * frame.axis.y;
    const std::array terms{1.0, x, y, x * x, x * y, y * y};
    for (std::size_t j = 0; j < sums.size(); ++j) sums[j] += w * terms[j] / (width * height);
  }
  return sums;
}

PartedPoints parted(const Map& map) { return {map.points, map.shares, part_count, width, height}; }

TEST(CellMoments, TheCoarsestLevelHasTheSumsOverAllTexels) {
  const Map map;
  for (const auto& [covariance, channels] :
       {std::pair{Covariance::full, std::vector<std::size_t>{0, 1, 2, 3, 4, 5}}, {Covariance::axes, {0, 1, 2, 3, 5}}}) {
    const auto frames = part_frames(parted(map), covariance);
    ASSERT_EQ(part_channels(covariance), static_cast<int>(channels.size()));
    for (int layer = 0; layer < layer_count(part_channels(covariance) * static_cast<int>(part_count)); ++layer) {
      const Image top = mip_chain(moment_layer(parted(map), frames, covariance, layer)).back();
      ASSERT_EQ(top.texel_count(), 1U);
      for (std::size_t c = 0; c < 4; ++c) {
        const std::size_t channel = 4 * static_cast<std::size_t>(layer) + c;
        const std::size_t part = channel / channels.size();
        const double sum =
            part < part_count ? expected(map, frames[part], part)[channels[channel % channels.size()]] : 0.0;
        EXPECT_NEAR(top.texels[c], sum, 1e-7) << "part " << part << ", channel " << channel % channels.size();
      }
    }
  }
}

// About the means nothing is left of the first moments, and along a part's own axes nothing of the mixed second one: no
// spread is lost at the coarsest level.
TEST(CellMoments, FramesAreTheMeansAndAxesOfTheParts) {
  const Map map;
  const auto frames = part_frames(parted(map), Covariance::axes);
  const auto upright = part_frames(parted(map), Covariance::full);
  for (std::size_t k = 0; k < part_count; ++k) {
    const auto sums = expected(map, frames[k], k);
    EXPECT_NEAR(sums[1], 0.0, 1e-12);
    EXPECT_NEAR(sums[2], 0.0, 1e-12);
    EXPECT_NEAR(sums[4], 0.0, 1e-12);
    EXPECT_GE(sums[3], sums[5]) << "the first axis is the longer one";
    EXPECT_NEAR(glm::length(frames[k].axis), 1.0, 1e-12);
    EXPECT_GT(std::abs(expected(map, upright[k], k)[4]), 1e-5) << "the gate: along the plane's axes there is some";
  }
  std::vector<float> empty_second;
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    empty_second.push_back(1.0F);
    empty_second.push_back(0.0F);
  }
  const auto of_two = part_frames({map.points, empty_second, 2, width, height}, Covariance::axes);
  EXPECT_EQ(of_two[0], of_two[1]) << "a part without texels has the mean and the axes of all";
}

// A texel has one normal: its own covariance is zero but for rounding, however small its share.
TEST(CellMoments, OneTexelHasNoSpread) {
  const std::vector<PlanePoint> points{{.at = {0.4, -0.3}, .weight = 1.0}};
  for (const float share : {1.0F, 0.3F, 1e-3F}) {
    const std::vector<float> shares{share, 1.0F - share};
    const Image first = moment_layer({points, shares, 2, 1, 1}, {}, Covariance::full, 0);
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
  const Image top = mip_chain(value_layer(parted(map), variance, 0)).back();
  for (std::size_t k = 0; k < part_count; ++k) {
    double sum = 0.0;
    for (std::size_t i = 0; i < map.points.size(); ++i)
      sum += map.points[i].weight * static_cast<double>(map.shares[i * part_count + k]) * 0.01 *
             static_cast<double>(i % 5);
    EXPECT_NEAR(top.texels[k], sum / (width * height), 1e-8);
  }
  EXPECT_EQ(top.texels[3], 0.0F);
  const Image one = value_layer(parted(map), Image(1, 1, 1, 0.5F), 0);
  EXPECT_NEAR(one.texels[4], 0.5 * map.shares[part_count], 1e-7) << "all of it is under one texel";
}

}  // namespace
}  // namespace footprint::cells
