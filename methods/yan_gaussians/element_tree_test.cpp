// The hierarchy has every point once, within its bounds, and is the same at any number of threads; elements have the
// slopes of their map.
#include "methods/yan_gaussians/elements.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

namespace footprint {
namespace {

struct Cloud {
  std::vector<TreePoint> points;
  std::vector<float> reach;
};

Cloud random_cloud(std::size_t count) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  Cloud cloud;
  for (std::size_t i = 0; i < count; ++i) {
    cloud.points.push_back({unit(random), unit(random), 0.6F * unit(random) - 0.3F, i % 2 == 0 ? 0.5F : -0.5F});
    cloud.reach.push_back(0.01F * unit(random));
  }
  return cloud;
}

class ElementTreeOf : public ::testing::TestWithParam<std::size_t> {};

TEST_P(ElementTreeOf, HasEveryPointOnceInLeavesOfAtMostEight) {
  const Cloud cloud = random_cloud(GetParam());
  const ElementTree tree = build_element_tree(cloud.points, cloud.reach);
  std::vector<std::uint32_t> sorted = tree.order;
  std::ranges::sort(sorted);
  for (std::uint32_t i = 0; i < sorted.size(); ++i) ASSERT_EQ(sorted[i], i);
  ASSERT_EQ(sorted.size(), GetParam());
  const std::size_t leaves = std::size_t{1} << tree.depth;
  EXPECT_EQ(tree.leaf_begin(0), 0U);
  EXPECT_EQ(tree.leaf_begin(leaves), GetParam());
  for (std::size_t leaf = 0; leaf < leaves; ++leaf) {
    ASSERT_GT(tree.leaf_begin(leaf + 1), tree.leaf_begin(leaf));
    ASSERT_LE(tree.leaf_begin(leaf + 1) - tree.leaf_begin(leaf), ElementTree::most_in_leaf);
  }
}

bool within(const TreePoint& point, float reach, const TreeBounds& bounds) {
  for (std::size_t axis = 0; axis < 4; ++axis) {
    const float wider = axis < 2 ? 0.0F : reach;
    if (point[axis] - wider < bounds.low[axis] || point[axis] + wider > bounds.high[axis]) return false;
  }
  return true;
}

TEST_P(ElementTreeOf, HasBoundsThatHoldWhatIsBelow) {
  const Cloud cloud = random_cloud(GetParam());
  const ElementTree tree = build_element_tree(cloud.points, cloud.reach);
  const std::size_t leaves = std::size_t{1} << tree.depth;
  for (std::size_t leaf = 0; leaf < leaves; ++leaf) {
    for (std::size_t i = tree.leaf_begin(leaf); i < tree.leaf_begin(leaf + 1); ++i) {
      const std::uint32_t point = tree.order[i];
      for (std::size_t node = leaves + leaf; node > 0; node /= 2)
        ASSERT_TRUE(within(cloud.points[point], cloud.reach[point], tree.nodes[node])) << "node " << node;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Counts, ElementTreeOf, ::testing::Values(1, 2, 8, 9, 15, 16, 17, 1000, 4096, 30001));

// Bounds around everything everywhere would pass the above: leaves are small in all four coordinates together.
TEST(ElementTree, HasLeavesThatAreSmall) {
  const Cloud cloud = random_cloud(1U << 15U);
  const ElementTree tree = build_element_tree(cloud.points, std::vector<float>(cloud.points.size(), 0.0F));
  double volume = 0.0;
  std::size_t mixed = 0;  // of both clouds: where one ends in the middle of a leaf
  const std::size_t leaves = std::size_t{1} << tree.depth;
  for (std::size_t node = leaves; node < 2 * leaves; ++node) {
    double product = 1.0;
    for (std::size_t axis = 0; axis < 3; ++axis) product *= tree.nodes[node].high[axis] - tree.nodes[node].low[axis];
    volume += product;
    mixed += tree.nodes[node].high[3] > tree.nodes[node].low[3] ? 1U : 0U;
  }
  EXPECT_LT(mixed, leaves / 16);
  EXPECT_LT(volume, 0.002 * 0.6 * static_cast<double>(leaves));  // of which every one would have 0.6 without an order
}

TEST(ElementTree, IsTheSameAtAnyNumberOfThreads) {
  Cloud cloud = random_cloud(50000);
  for (TreePoint& point : cloud.points) point[2] = std::round(20.0F * point[2]);  // many alike
  const ElementTree tree = build_element_tree(cloud.points, cloud.reach);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(build_element_tree(cloud.points, cloud.reach), tree);
}

Material material_of(Image normals, const std::array<Wrap, 2>& wrap = {Wrap::repeat, Wrap::repeat}) {
  Material material;
  material.normal_map = TextureMap{"normals", std::make_shared<const Image>(std::move(normals)), {.wrap = wrap}};
  return material;
}

// Normals whose x is a sine of the column.
Image waves(int width, int height) {
  Image map(width, height, 4, 1.0F);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double nx = 0.2 * std::sin(2.0 * 3.14159265358979 * (x + 0.5) / width);
      const glm::vec3 normal(nx, 0.1, std::sqrt(1.0 - nx * nx - 0.01));
      std::copy_n(&normal.x, 3, map.at(x, y).begin());
    }
  }
  return map;
}

TEST(Elements, HaveTheSlopesOfTheirMapAcrossItsBorderToo) {
  const Elements elements = make_elements(material_of(waves(64, 4)), true);
  for (int x = 0; x < 64; ++x) {
    const std::span<const float> slopes = elements.jacobians.at(x, 1);
    const double turn = 2.0 * 3.14159265358979 / 64;
    EXPECT_NEAR(slopes[0], 0.2 * turn * std::cos(turn * (x + 0.5)), 1e-4) << x;
    EXPECT_EQ(slopes[1], 0.0F);
    EXPECT_EQ(slopes[3], 0.0F);
  }
  EXPECT_TRUE(make_elements(material_of(waves(8, 4)), false).jacobians.empty());
}

TEST(Elements, OfAMapThatDoesNotRepeatAreFollowedByTheirMirrorImage) {
  const Image map = waves(8, 4);
  const Elements elements = make_elements(material_of(map, {Wrap::mirrored_repeat, Wrap::repeat}), true);
  ASSERT_EQ(elements.normals.width, 16);
  ASSERT_EQ(elements.normals.height, 4);
  for (int x = 0; x < 8; ++x) {
    EXPECT_TRUE(std::ranges::equal(elements.normals.at(x, 1), elements.normals.at(15 - x, 1)));
    EXPECT_NEAR(elements.normals.at(x, 1)[0], map.at(x, 1)[0], 1e-6);
  }
}

// Hard case 25: a hole becomes what is around it, and a map of nothing but holes is flat.
TEST(Elements, FillHoles) {
  Image map(8, 8, 4, 1.0F);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      const glm::vec3 normal(0.28F, 0.0F, 0.96F);
      std::copy_n(&normal.x, 3, map.at(x, y).begin());
    }
  }
  std::ranges::fill(map.at(3, 3), 0.0F);
  const Elements elements = make_elements(material_of(map), true);
  for (std::size_t i = 0; i < 64; ++i) {
    EXPECT_NEAR(elements.normals.texels[4 * i], 0.28F, 1e-6);
    EXPECT_NEAR(elements.normals.texels[4 * i + 2], 0.96F, 1e-6);
    EXPECT_EQ(elements.normals.texels[4 * i + 3], 1.0F);
  }
  EXPECT_EQ(make_elements(material_of(Image(4, 4, 4, 0.0F)), true).normals.at(2, 2)[2], 1.0F);
}

}  // namespace
}  // namespace footprint
