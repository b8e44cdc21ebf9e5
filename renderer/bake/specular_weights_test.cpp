// Weights by luminance, and colours over the texels of another map.
#include "renderer/bake/material_maps.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

Material coloured(const Image& colours) {
  Material material = lobe_material(constant_normals(4, 2, {0, 0, 1}), NormalDistribution::ggx, 0.3F);
  material.specular_map = TextureMap{"colours", std::make_shared<const Image>(colours), {}};
  return material;
}

TEST(SpecularWeights, AreTheLuminanceOverTheLargest) {
  Image colours(3, 1, 3);
  colours.texels = {0.5F, 0.5F, 0.5F, 0.0F, 0.0F, 0.0F, 0.0F, 0.25F, 0.0F};
  const Image weights = specular_weights(colours);
  EXPECT_NEAR(weights.texels[0], 1.0F, 1e-6F);
  EXPECT_EQ(weights.texels[1], 0.0F);
  EXPECT_NEAR(weights.texels[2], 0.25F * 0.7152F / 0.5F, 1e-6F);
  EXPECT_EQ(specular_weights(Image(2, 2, 3)).texels, Image(2, 2, 1).texels) << "black";
}

TEST(SpecularOver, HasTheNearestColourOfEachTexel) {
  Image colours(2, 1, 3, 0.25F);
  colours.at(1, 0)[2] = 0.75F;
  const Material material = coloured(colours);
  const std::optional<Image> over = specular_over(material, {4, 2}, normal_coordinates(material));
  ASSERT_TRUE(over.has_value());
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 4; ++x) EXPECT_EQ(over->at(x, y)[2], x < 2 ? 0.25F : 0.75F);
  }
}

TEST(SpecularOver, NeedsTheSamePlaceAndNoFinerMap) {
  Material material = coloured(Image(4, 2, 3, 0.5F));
  EXPECT_TRUE(specular_over(material, {4, 2}, {}).has_value());
  EXPECT_FALSE(specular_over(material, {2, 2}, {}).has_value()) << "finer";
  material.specular_map->coordinates.set = 1;
  EXPECT_FALSE(specular_over(material, {4, 2}, {}).has_value()) << "elsewhere";
  material.specular_map.reset();
  EXPECT_EQ(specular_over(material, {4, 2}, {.set = 1}), Image(4, 2, 3, 1.0F)) << "no map";
}

}  // namespace
}  // namespace footprint::testing
