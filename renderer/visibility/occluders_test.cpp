// Rays against triangles: what blocks them, what is cut out, what they meet first.
#include "renderer/visibility/occluders.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <utility>

#include "tests/support/shadow_scenes.hpp"

namespace footprint::testing {
namespace {

glm::vec3 random_direction(std::mt19937& random) {
  std::normal_distribution<float> normal;
  return glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
}

// A ray meets a sphere where the quadratic says; the mesh is within its sagitta of the sphere.
TEST(Occluders, AgreeWithASphere) {
  Scene scene = white_floor();
  scene.meshes = {sphere_mesh({0.1F, -0.2F, 0.3F}, 0.5F, 200)};
  fit_bounds(scene);
  const Occluders occluders(scene);
  std::mt19937 random(3);
  for (int i = 0; i < 2000; ++i) {
    const glm::vec3 origin = 2.0F * random_direction(random);
    const glm::vec3 direction = glm::normalize(0.6F * random_direction(random) - origin);
    const glm::vec3 to_centre = glm::vec3(0.1F, -0.2F, 0.3F) - origin;
    const float along = glm::dot(to_centre, direction);
    const float miss = std::sqrt(std::max(glm::dot(to_centre, to_centre) - along * along, 0.0F));
    if (std::abs(miss - 0.5F) < 1e-3F) continue;
    EXPECT_EQ(occluders.blocked(origin, direction), miss < 0.5F);
    const auto point = occluders.nearest(origin, direction);
    ASSERT_EQ(point.has_value(), miss < 0.5F);
    if (!point) continue;
    const float distance = along - std::sqrt(0.25F - miss * miss);
    EXPECT_NEAR(glm::distance(occluders.position(*point), origin), distance, 2e-2F);
    EXPECT_NEAR(glm::distance(occluders.position(*point), glm::vec3(0.1F, -0.2F, 0.3F)), 0.5F, 1e-3F);
    EXPECT_LT(glm::dot(occluders.normal(point->mesh, point->triangle), direction), 0.0F);
    EXPECT_FALSE(occluders.blocked(origin, direction, distance - 2e-2F));
  }
}

// A mask of two by two texels, one of them open: rays through its quarter pass, under each way of wrapping.
TEST(Occluders, LetHolesThrough) {
  Scene scene = white_floor();
  Image mask(2, 2, 4, 1.0F);
  mask.at(0, 0)[3] = 0.2F;  // v = 0 is the top row: y > 0
  Material& material = scene.materials[0];
  material.alpha_cutoff = 0.5F;
  material.base_color_map = TextureMap{"mask", std::make_shared<const Image>(mask), {}};
  const auto open = [&](float x, float y) { return !Occluders(scene).blocked({x, y, -1.0F}, {0, 0, 1}); };
  EXPECT_TRUE(open(-0.5F, 0.5F));
  EXPECT_FALSE(open(0.5F, 0.5F));
  EXPECT_FALSE(open(-0.5F, -0.5F));
  material.base_color_map->coordinates.set = 1;  // by its second set the whole floor is the open texel
  for (Vertex& vertex : scene.meshes[0].vertices) vertex.uv1 = glm::vec2(0.25F);
  EXPECT_TRUE(open(0.5F, 0.5F));
  material.base_color_map->coordinates.set = 0;
  glm::mat3x2& transform = material.base_color_map->coordinates.transform;
  transform = glm::mat3x2(1, 0, 0, 1, 1, 0);  // a whole tile to the right
  EXPECT_TRUE(open(-0.5F, 0.5F));
  material.base_color_map->coordinates.wrap = {Wrap::mirrored_repeat, Wrap::repeat};
  EXPECT_FALSE(open(-0.5F, 0.5F));
  EXPECT_TRUE(open(0.5F, 0.5F));
  material.base_color_map->coordinates.wrap = {Wrap::clamp_to_edge, Wrap::repeat};
  EXPECT_FALSE(open(-0.5F, 0.5F));
  EXPECT_FALSE(open(0.5F, 0.5F));
}

// A surface with the cutoff's own alpha is there, as in glTF.
TEST(Occluders, AlphaOfTheCutoffBlocks) {
  Scene scene = white_floor();
  scene.materials[0].alpha_cutoff = 0.5F;
  for (const auto& [alpha, blocks] : {std::pair(0.5F, true), std::pair(0.499F, false)}) {
    scene.materials[0].base_color.a = alpha;
    EXPECT_EQ(Occluders(scene).blocked({0.1F, 0.2F, -1.0F}, {0, 0, 1}), blocks);
  }
}

// The floor faces +z: from below light passes it, as if the floor were not there, and so it does on rays along light.
TEST(Occluders, OneSidedTrianglesBlockLightToTheirFrontAlone) {
  const Scene scene = white_floor();
  const Occluders occluders(scene);
  EXPECT_TRUE(occluders.open_from_behind(0));
  EXPECT_TRUE(occluders.blocked({0.3F, 0.2F, -1.0F}, {0, 0, 1}));
  EXPECT_FALSE(occluders.blocked({0.3F, 0.2F, 1.0F}, {0, 0, -1}));
  EXPECT_EQ(occluders.blocked({0.3F, 0.2F, 1.0F}, std::array{glm::vec3{0, 0, -1}, glm::vec3{0, 0, 1}}),
            (std::vector<bool>{false, false}));
  EXPECT_TRUE(occluders.nearest({0.3F, 0.2F, 1.0F}, {0, 0, -1}));
  EXPECT_FALSE(occluders.nearest({0.3F, 0.2F, -1.0F}, {0, 0, 1}));
}

TEST(Occluders, BothSidesBlockWhereTheyAreDrawnOrTheSceneSaysSo) {
  Scene scene = white_floor(), double_sided = scene;
  scene.shadows.both_sides = true;
  double_sided.materials[0].double_sided = true;
  EXPECT_TRUE(Occluders(double_sided).blocked({0.3F, 0.2F, 1.0F}, {0, 0, -1}));
  const Occluders occluders(scene);
  EXPECT_TRUE(occluders.blocked({0.3F, 0.2F, 1.0F}, {0, 0, -1}));
  EXPECT_TRUE(occluders.blocked({0.3F, 0.2F, -1.0F}, {0, 0, 1}));
  EXPECT_FALSE(occluders.blocked({0.3F, 0.2F, 1.0F}, {0, 0, -1}, 0.9F));
  EXPECT_FALSE(occluders.nearest({0.3F, 0.2F, 1.0F}, {0, 0, 1}));
}

}  // namespace
}  // namespace footprint::testing
