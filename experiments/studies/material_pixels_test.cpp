// Masks of materials: those of squares side by side, and what is in none.
#include "experiments/studies/material_pixels.hpp"

#include <gtest/gtest.h>

#include "renderer/pipeline/unresolved.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

// The square, its left quarter of another material, bumpy and metallic, lit from elsewhere.
Scene two_materials() {
  Scene scene = square_scene(random_normals(16, 16, 0.8F, 1), {});
  Material other = scene.materials.front();
  other.name = "other";
  other.metallic = 1.0F;
  other.base_color = glm::vec4(0.0F, 0.0F, 0.0F, 1.0F);
  scene.materials.push_back(other);
  Mesh left = scene.meshes.front();
  left.material = 1;
  for (Vertex& vertex : left.vertices) {
    vertex.position.x = 0.25F * vertex.position.x - 0.75F;
    vertex.position.z = 0.01F;
  }
  scene.meshes.push_back(left);
  return scene;
}

TEST(MaterialPixels, AreWhereEachMaterialIsSeen) {
  const Scene scene = two_materials();
  MaterialFinder finder(shared_context().info(), scene, {32, 32}, 0);
  Image interior(32, 32, 1, 1.0F);
  interior.at(30, 5)[0] = 0.0F;
  const auto masks = finder.masks({.size = {32, 32}, .camera = scene.camera}, interior);
  ASSERT_EQ(masks.size(), 2U);
  EXPECT_EQ(pixel_count(masks[1]), 32U * 8U);
  EXPECT_EQ(pixel_count(masks[0]), 32U * 24U - 1U);
  EXPECT_EQ(masks[1].at(3, 3)[0], 1.0F);
  EXPECT_EQ(masks[0].at(3, 3)[0], 0.0F);
  EXPECT_EQ(masks[0].at(30, 5)[0], 0.0F);
}

TEST(MaterialPixels, AreNowhereBesideTheObject) {
  const Scene scene = two_materials();
  MaterialFinder finder(shared_context().info(), scene, {32, 32}, 0);
  View view{.size = {32, 32}, .camera = scene.camera};
  view.camera.world[3].z = 12.0F;
  const auto masks = finder.masks(view, Image(32, 32, 1, 1.0F));
  EXPECT_LT(pixel_count(masks[0]) + pixel_count(masks[1]), 100U);
  EXPECT_GT(pixel_count(masks[0]), 20U);
}

}  // namespace
}  // namespace footprint::testing
