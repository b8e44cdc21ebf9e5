// Texels are divided by roughness first, then by their normals.
#include "methods/cells/partition.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace footprint::cells {
namespace {

const Progress unheard = [](std::string_view, double) {};

// Two walls in columns of four texels; every second row is rough.
struct Walls {
  std::vector<PlanePoint> points;
  std::vector<double> variances;
};

constexpr int side = 16;

Walls walls(double smooth, double rough) {
  Walls walls;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      walls.points.push_back({.at = {x / 4 % 2 == 0 ? 0.3 : -0.3, 0.0}, .weight = 1.0});
      walls.variances.push_back(y % 2 == 0 ? smooth : rough);
    }
  }
  return walls;
}

TEST(Halves, GroupsAreNearTheirMeans) {
  EXPECT_EQ(upper_group(std::vector<double>{1, 9, 2, 10, 1.5}), (std::vector<bool>{false, true, false, true, false}));
  // From the middle of the extremes, 5.5, the boundary moves to the means' own.
  EXPECT_EQ(upper_group(std::vector<double>{0, 0, 0, 0, 5.2, 6, 11}),
            (std::vector<bool>{false, false, false, false, true, true, true}));
  EXPECT_EQ(upper_group(std::vector<double>{3, 3, 3}), (std::vector<bool>{false, false, false}));
  EXPECT_TRUE(upper_group({}).empty());
}

TEST(Halves, EachGroupHasPartsOfItsOwn) {
  const Walls map = walls(0.001, 0.1);
  const std::vector<float> shares =
      partition_with_roughness(map.points, map.variances, side, side, {.parts = 4}, unheard);
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    const bool rough = map.variances[i] > 0.01;
    EXPECT_NEAR(shares[4 * i] + shares[4 * i + 1], rough ? 0.0 : 1.0, 1e-6) << i;
    EXPECT_NEAR(shares[4 * i + 2] + shares[4 * i + 3], rough ? 1.0 : 0.0, 1e-6) << i;
    const std::size_t own = 4 * i + (rough ? 2 : 0);
    EXPECT_NEAR(std::max(shares[own], shares[own + 1]), 1.0, 1e-3) << "and a part has one wall";
  }
}

TEST(Halves, AnOddPartGoesToTheNarrowerLobes) {
  const Walls map = walls(0.001, 0.1);
  const std::vector<float> shares =
      partition_with_roughness(map.points, map.variances, side, side, {.parts = 3}, unheard);
  EXPECT_NEAR(shares[0] + shares[1], 1.0, 1e-6) << "the first row is smooth";
  EXPECT_EQ(shares[3 * side + 2], 1.0F) << "the second is rough";
}

TEST(Halves, OneRoughnessIsAPlainPartition) {
  const Walls map = walls(0.01, 0.01);
  const PartitionSettings settings{.parts = 4};
  EXPECT_EQ(partition_with_roughness(map.points, map.variances, side, side, settings, unheard),
            partition(map.points, side, side, settings, unheard));
}

}  // namespace
}  // namespace footprint::cells
