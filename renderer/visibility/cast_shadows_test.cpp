// Whether something casts a shadow: cases that geometry decides.
#include "renderer/visibility/cast_shadows.hpp"

#include <gtest/gtest.h>

#include "tests/support/shadow_scenes.hpp"

namespace footprint::testing {
namespace {

const Light from_above = DirectionalLight{.direction = {0.3F, 0.2F, -0.9327379F}, .illuminance = glm::vec3(1.0F)};

bool casts(Scene scene, const Light& light) {
  scene.lights = {light};
  return lights_casting_shadows(scene, Occluders(scene)).front();
}

Scene one_body(Mesh mesh) {
  Scene scene = white_floor();
  scene.meshes = {std::move(mesh)};
  fit_bounds(scene);
  return scene;
}

TEST(CastShadows, PlaneCastsNoneEvenUnderGrazingLight) {
  EXPECT_FALSE(casts(white_floor(), from_above));
  EXPECT_FALSE(
      casts(white_floor(), DirectionalLight{.direction = {0.9999F, 0.0F, -0.01414F}, .illuminance = glm::vec3(1)}));
  EXPECT_FALSE(
      casts(white_floor(), PointLight{.position = {0.2F, 0.1F, 0.01F}, .intensity = glm::vec3(1), .range = {}}));
  EXPECT_FALSE(
      casts(white_floor(), PointLight{.position = {0.2F, 0.1F, -1.0F}, .intensity = glm::vec3(1), .range = {}}));
}

TEST(CastShadows, ConvexBodiesCastNoneOnThemselves) {
  const PointLight near{.position = {0.2F, 1.3F, 0.4F}, .intensity = glm::vec3(1), .range = {}};
  for (const int rings : {3, 8, 40}) {
    EXPECT_FALSE(casts(one_body(sphere_mesh({1, 2, 3}, 0.7F, rings)), from_above)) << rings;
    EXPECT_FALSE(casts(one_body(sphere_mesh({0, 0, 0}, 1.0F, rings)), near)) << rings;
  }
  EXPECT_FALSE(casts(one_body(box_mesh({-1, -1, -1}, {1, 1, 1})), near));
  EXPECT_FALSE(casts(one_body(box_mesh({-1, -1, -1e-4F}, {1, 1, 1e-4F})), from_above));
}

TEST(CastShadows, BoxOverFloorCastsOne) {
  EXPECT_TRUE(casts(box_over_floor(), from_above));
  EXPECT_TRUE(casts(box_over_floor(), PointLight{.position = {0, 0, 3}, .intensity = glm::vec3(1), .range = {}}));
}

// A sphere shines to all sides, whatever its direction; a disk that faces away shines on nothing.
TEST(CastShadows, SpheresShineToAllSides) {
  AreaLight light{.shape = AreaShape::sphere, .position = {0, 0, 3}, .direction = {0, 0, 1}};
  EXPECT_TRUE(casts(box_over_floor(), light));
  light.shape = AreaShape::disk;
  EXPECT_FALSE(casts(box_over_floor(), light));
}

// From below light comes to the back of the floor, which is not drawn from there.
TEST(CastShadows, WhatIsNotDrawnFromTheLightCastsNone) {
  const DirectionalLight from_below{.direction = {0, 0, 1}, .illuminance = glm::vec3(1)};
  Scene scene = box_over_floor();
  EXPECT_FALSE(casts(scene, from_below));
  scene.shadows.both_sides = true;
  EXPECT_TRUE(casts(scene, from_below));
  scene.shadows.both_sides = false;
  scene.materials[0].double_sided = true;
  EXPECT_TRUE(casts(scene, from_below));
}

TEST(CastShadows, LightBetweenBoxAndFloorReachesBoth) {
  EXPECT_FALSE(casts(box_over_floor(), PointLight{.position = {0, 0, 0.1F}, .intensity = glm::vec3(1), .range = {}}));
}

TEST(CastShadows, LightCountsOnlyWhereItShines) {
  const PointLight lamp{.position = {0.8F, 0.8F, 1.0F}, .intensity = glm::vec3(1), .range = 0.3F};
  EXPECT_FALSE(casts(box_over_floor(), lamp));
  PointLight far = lamp;
  far.range = 10.0F;
  EXPECT_TRUE(casts(box_over_floor(), far));
  SpotLight spot{.point = far, .direction = {0, 0, -1}, .inner_cone_angle = 0.0F, .outer_cone_angle = 0.1F};
  EXPECT_FALSE(casts(box_over_floor(), spot));
  spot.outer_cone_angle = 1.2F;
  EXPECT_TRUE(casts(box_over_floor(), spot));
  far.intensity = glm::vec3(0.0F);
  EXPECT_FALSE(casts(box_over_floor(), far));
}

// Small things are found over something large and under it.
TEST(CastShadows, SmallPartsAreFound) {
  Scene speck = white_floor();
  speck.meshes.push_back(box_mesh({0.337F, -0.511F, 0.2F}, {0.338F, -0.510F, 0.201F}));
  EXPECT_TRUE(casts(speck, from_above));
  Scene roof = speck;
  for (Vertex& vertex : roof.meshes[0].vertices) vertex.position.z = 1.0F;
  EXPECT_TRUE(casts(roof, from_above));
}

TEST(CastShadows, OpenShellCastsOneInsideOnlyWhereTheInsideIsSeen) {
  Scene bowl = one_body(sphere_mesh({0, 0, 0}, 1.0F, 16));
  std::vector<std::uint32_t>& indices = bowl.meshes[0].indices;
  indices.resize(indices.size() / 2);  // the upper half: light from above meets the outside first
  EXPECT_FALSE(casts(bowl, from_above));
  bowl.materials[0].double_sided = true;
  EXPECT_TRUE(casts(bowl, from_above));
}

TEST(CastShadows, WhatIsCutOutCastsNone) {
  Scene scene = box_over_floor();
  scene.meshes[1].material = 1;
  scene.materials.push_back(scene.materials[0]);
  scene.materials[1].alpha_cutoff = 0.5F;
  EXPECT_TRUE(casts(scene, from_above));
  scene.materials[1].base_color.a = 0.4F;
  EXPECT_FALSE(casts(scene, from_above));
}

TEST(CastShadows, DegenerateTrianglesAreNoOnesConcern) {
  Scene scene = white_floor();
  for (Vertex& vertex : scene.meshes[0].vertices) vertex.position = {1, 1, 1};
  fit_bounds(scene);
  EXPECT_FALSE(casts(scene, from_above));
}

TEST(CastShadows, PointsAreSpreadByArea) {
  Scene scene = white_floor();
  scene.meshes.push_back(box_mesh({3, 3, 0}, {4, 4, 1}));
  fit_bounds(scene);
  const Occluders occluders(scene);
  const auto points = spread_points(scene, occluders, 14);
  ASSERT_EQ(points.size(), 14U * 5U);
  std::size_t on_floor = 0;
  for (std::size_t i = 14U * 4U; i < points.size(); ++i) on_floor += points[i].mesh == 0 ? 1 : 0;
  EXPECT_NEAR(static_cast<double>(on_floor), 14.0 * 4.0 / (4.0 + 6.0), 1.0);
  for (const SurfacePoint& point : points) EXPECT_TRUE(point.u >= 0.0F && point.v >= 0.0F && point.u + point.v <= 1.0F);
}

}  // namespace
}  // namespace footprint::testing
