// Maps of anisotropy beside constant widths, maps of another size, and maps elsewhere.
#include "renderer/scene/assembly/anisotropy_map.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "tests/support/says.hpp"

namespace footprint {
namespace {

TextureMap one_map(Image image) { return {"map", std::make_shared<const Image>(std::move(image)), {}}; }

Material stretched_material() {
  Material material;
  material.name = "steel";
  material.roughness = 0.3F;
  material.metallic = 0.75F;
  material.anisotropy = Anisotropy{0.5F, 0.0F};
  Image axes(2, 1, 2, 0.0F);
  axes.texels = {0.25F, 0.0F, 0.0F, 0.16F};
  material.anisotropy_map = one_map(std::move(axes));
  return material;
}

std::vector<std::string> laid(Material& material) {
  std::vector<std::string> warnings;
  lay_anisotropy(material, warnings);
  return warnings;
}

TEST(AnisotropyMap, GetsAMapOfAConstantWidthBesideIt) {
  Material material = stretched_material();
  material.anisotropy_map->coordinates.transform[0].x = 3.0F;
  EXPECT_TRUE(laid(material).empty());
  ASSERT_NE(width_map(material), nullptr);
  EXPECT_EQ(width_map(material)->coordinates, material.anisotropy_map->coordinates);
  EXPECT_EQ(width_map(material)->image.decoded().texels, (std::vector<float>{0.3F, 0.75F, 0.3F, 0.75F}));
  Material given = stretched_material();
  given.lobe_parameter = 0.2F;
  EXPECT_TRUE(laid(given).empty());
  ASSERT_NE(width_map(given), nullptr);
  EXPECT_EQ(width_map(given)->image.decoded().texels, (std::vector<float>{0.2F, 0.2F}));
}

TEST(AnisotropyMap, HasTheLargerSizeOfBoth) {
  Material material = stretched_material();
  Image rough(1, 4, 2, 0.0F);
  for (std::size_t i = 0; i < 4; ++i) rough.texels[2 * i] = 0.1F * static_cast<float>(i);
  material.metallic_roughness_map = one_map(std::move(rough));
  EXPECT_TRUE(laid(material).empty());
  for (const TextureMap& map : {*material.anisotropy_map, *material.metallic_roughness_map}) {
    EXPECT_EQ(map.image.width(), 2);
    EXPECT_EQ(map.image.height(), 4);
  }
  EXPECT_EQ(material.anisotropy_map->image.decoded().at(1, 3)[1], 0.16F);
  EXPECT_EQ(material.metallic_roughness_map->image.decoded().at(1, 3)[0], 0.3F);
}

TEST(AnisotropyMap, IsItsMeanWithAWarningWhereTheWidthsLieElsewhere) {
  Material material = stretched_material();
  material.metallic_roughness_map = one_map(Image(2, 2, 2, 0.5F));
  material.metallic_roughness_map->coordinates.set = 1;
  const std::vector<std::string> warnings = laid(material);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_TRUE(test::says(warnings.front(), "a strength of 0.5 at 0 degrees")) << warnings.front();
  EXPECT_FALSE(material.anisotropy_map);
  EXPECT_TRUE(material.anisotropy);
}

}  // namespace
}  // namespace footprint
