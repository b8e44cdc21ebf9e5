// Roughness mips as engines import them, and the model with them written back: a plain viewer of the smaller model
// draws what the method draws of the large one.
#include "renderer/baked_files/baked_files.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "methods/registry.hpp"
#include "renderer/image/metrics.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/says.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

constexpr int texels = 64;

Scene bumpy_square(float roughness = 0.5F) {
  return square_scene(random_normals(texels, texels, 0.45F, 7), {.brdf = {}, .roughness = roughness});
}

EngineMaps maps_of(const Scene& scene, const std::string& text) {
  const MethodSpec spec = parse_methods(text).front();
  const BakedMethod baked = bake(find_method(spec), spec, scene, effects_on(derive_effects(scene)), no_progress);
  return engine_maps(baked, scene.materials.front());
}

// The length of the mean of the unit normals of a block, from the finest level, in doubles.
double mean_length(const Image& normals, int x, int y, int side) {
  glm::dvec3 sum(0.0);
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const auto n = normals.at(x * side + i, y * side + j);
      sum += glm::normalize(glm::dvec3(n[0], n[1], n[2]));
    }
  }
  return glm::length(sum) / (side * side);
}

// Godot's and Filament's formulas by themselves (methods/roughness_bake/README.md), to a byte.
TEST(EngineMaps, AreTheFormulaOfTheFinestNormals) {
  const Scene scene = bumpy_square();
  const Image normals = scene.materials.front().normal_map->image.decoded();
  const EngineMaps godot = maps_of(scene, "roughness_bake:preset=godot");
  const EngineMaps filament = maps_of(scene, "roughness_bake:preset=filament");
  for (const int level : {1, 3, 6}) {
    const int side = 1 << level;
    for (int y = 0; y < texels / side; y += 3) {
      for (int x = 0; x < texels / side; x += 2) {
        const double r = mean_length(normals, x, y, side), inverse_kappa = (1 - r * r) / (3 * r - r * r * r);
        const auto at = [&](const EngineMaps& maps) {
          return double{decode_level(maps.textures[1], static_cast<std::size_t>(level)).at(x, y)[0]};
        };
        EXPECT_NEAR(at(godot), std::sqrt(0.25 + std::min(0.75 * inverse_kappa, 0.16)), 0.51 / 255);
        EXPECT_NEAR(at(filament), std::pow(0.0625 + 2 * inverse_kappa, 0.25), 0.51 / 255);
      }
    }
  }
}

TEST(EngineMaps, JoinAMapOfRoughness) {
  Scene scene = bumpy_square();
  Image rough(16, 16, 2, 0.0F);
  for (std::size_t i = 0; i < rough.texel_count(); ++i) rough.texels[2 * i] = i % 2 == 0 ? 0.3F : 0.6F;
  scene.materials[0].metallic_roughness_map = TextureMap{"rough", std::make_shared<const Image>(rough), {}};
  const EngineMaps maps = maps_of(scene, "roughness_bake:preset=order1886");
  ASSERT_EQ(maps.textures.size(), 2U);
  EXPECT_EQ(maps.textures[1].levels.front().width, texels);
  // Its own texels at the finest level, where all normals agree; the mean below the roughness map's finest level.
  const Image finest = decode_level(maps.textures[1], 0);
  EXPECT_NEAR(finest.at(0, 0)[0], 0.3, 0.01);
  EXPECT_NEAR(finest.at(4, 0)[0], 0.6, 0.01);
  const double r = mean_length(scene.materials[0].normal_map->image.decoded(), 1, 1, 8);
  const double alpha2 = std::pow(0.45, 4), inverse_kappa = (1 - r * r) / (3 * r - r * r * r);
  EXPECT_NEAR(decode_level(maps.textures[1], 3).at(1, 1)[0], std::pow(alpha2 + inverse_kappa, 0.25), 1.0 / 255);
}

TEST(EngineMaps, AreNotThereOfOtherMethodsAndMaterials) {
  EXPECT_TRUE(maps_of(bumpy_square(), "toksvig").textures.empty());
  EXPECT_TRUE(maps_of(bumpy_square(), "toksvig").missing.empty());
  Scene turned = bumpy_square();
  Image rough(4, 4, 2, 0.5F);
  rough.texels[0] = 0.2F;
  turned.materials[0].metallic_roughness_map = TextureMap{"rough", std::make_shared<const Image>(rough), {}};
  turned.materials[0].metallic_roughness_map->coordinates.transform[2] = {0.5F, 0.0F};
  EXPECT_TRUE(test::says(maps_of(turned, "roughness_bake").missing, "different texture coordinates"));
  Scene odd = bumpy_square();
  Image uneven(5, 4, 2, 0.5F);
  uneven.texels[0] = 0.2F;
  odd.materials[0].metallic_roughness_map = TextureMap{"rough", std::make_shared<const Image>(uneven), {}};
  EXPECT_TRUE(test::says(maps_of(odd, "roughness_bake").missing, "no common mip levels"));
}

// The square with its maps replaced, as the glTF copy has them.
Scene with_level(const Scene& scene, const std::string& text, int level, bool with_roughness) {
  const ReplacedMaps maps = replaced_maps(maps_of(scene, text), scene.materials[0], level);
  const Image &normal = maps.normal.front(), &rough_metallic = maps.rough_metallic.front();
  Image normals(normal.width, normal.height, 4, 1.0F), rough(normal.width, normal.height, 2, 0.0F);
  for (std::size_t i = 0; i < normals.texel_count(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) normals.texels[4 * i + c] = 2.0F * normal.texels[3 * i + c] - 1.0F;
    rough.texels[2 * i] = rough_metallic.texels[3 * i + 1];
  }
  Scene small = scene;
  small.materials[0].normal_map->image = std::make_shared<const Image>(normals);
  if (with_roughness)
    small.materials[0].metallic_roughness_map = TextureMap{"rough", std::make_shared<const Image>(rough), {}};
  return small;
}

// A pixel is four texels wide: a level 2 that became the finest one shows it all. What the dropped levels knew is in
// the roughness; without it the small model looks otherwise.
TEST(EngineMaps, OfASmallerModelHoldWhatItLost) {
  const Scene scene = bumpy_square(0.2F);
  const Image whole = TestRenderer(scene, {16, 16}).frame(find_method("roughness_bake"));
  const auto error_of = [&](const Scene& seen) {
    return normalized_color(TestRenderer(seen, {16, 16}).frame(find_method("naive_mip")), whole, 1.0F).value();
  };
  const double with = error_of(with_level(scene, "roughness_bake", 2, true));
  const double without = error_of(with_level(scene, "roughness_bake", 2, false));
  EXPECT_LT(with, 0.2 * without) << with << " and " << without;
}

}  // namespace
}  // namespace footprint::testing
