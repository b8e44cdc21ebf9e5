// The tree that shaders trace rays through, against Embree's own rays.
#include "renderer/visibility/ray_tree.hpp"

#include <gtest/gtest.h>

#include <random>

#include "renderer/visibility/occluders.hpp"
#include "tests/support/shadow_scenes.hpp"

namespace footprint::testing {
namespace {

TEST(RayTree, AgreesWithEmbree) {
  Scene scene = box_over_floor();
  scene.meshes.push_back(sphere_mesh({0.5F, -0.5F, 0.3F}, 0.25F, 24));
  fit_bounds(scene);
  const RayTree tree = ray_tree(scene);
  const Occluders occluders(scene);
  std::mt19937 random(5);
  std::normal_distribution<float> normal;
  std::size_t blocked = 0, differing = 0;
  for (int i = 0; i < 20000; ++i) {
    const glm::vec3 origin(0.8F * normal(random), 0.8F * normal(random), 0.4F * normal(random));
    const glm::vec3 direction = glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
    const bool truth = occluders.blocked(origin, direction);
    blocked += truth ? 1 : 0;
    differing += tree.blocked(origin, direction) == truth ? 0 : 1;
  }
  EXPECT_GT(blocked, 4000U);
  EXPECT_LE(differing, 2U);  // rays that meet an edge
}

TEST(RayTree, RaysAlongAxesAndFromWithinBoxes) {
  const Scene scene = white_floor();
  const RayTree tree = ray_tree(scene);
  EXPECT_TRUE(tree.blocked({0.3F, 0.2F, 1.0F}, {0, 0, -1}));
  EXPECT_FALSE(tree.blocked({0.3F, 0.2F, 1.0F}, {0, 0, 1}));
  EXPECT_FALSE(tree.blocked({0.3F, 0.2F, 1.0F}, {1, 0, 0}));
  EXPECT_FALSE(tree.blocked({0.3F, 0.2F, 0.0F}, {1, 0, 0}));
  EXPECT_FALSE(tree.blocked({3.0F, 0.2F, 1.0F}, {0, 0, -1}));
}

TEST(RayTree, SkipsLeadForwardToTheEnd) {
  const RayTree tree = ray_tree(box_over_floor());
  ASSERT_EQ(tree.triangles.size(), 14U);
  EXPECT_EQ(tree.nodes.front().skip, tree.nodes.size());
  std::size_t held = 0;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    EXPECT_GT(tree.nodes[i].skip, i);
    EXPECT_LE(tree.nodes[i].skip, tree.nodes.size());
    held += tree.nodes[i].triangles % 8;
  }
  EXPECT_EQ(held, 14U);
}

TEST(RayTree, OneTriangle) {
  Scene scene = white_floor();
  scene.meshes[0].indices.resize(3);
  EXPECT_EQ(ray_tree(scene).triangles.size(), 1U);
}

}  // namespace
}  // namespace footprint::testing
