// The estimate of what a scene's maps take, worked out by hand.
#include "experiments/studies/memory_estimate.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace footprint {
namespace {

constexpr std::uint64_t texels = 64ULL * 48ULL;

TextureMap map_of(const std::shared_ptr<const Image>& image) { return {"map", image, {}}; }

EffectSet effects_of(std::initializer_list<Effect> on) {
  EffectSet set;
  for (const Effect effect : on) set.set(static_cast<std::size_t>(effect));
  return set;
}

Scene two_materials() {
  const auto normals = std::make_shared<const Image>(64, 48, 4, 0.5F);
  Scene scene;
  scene.materials.resize(2);
  for (Material& material : scene.materials) material.normal_map = map_of(normals);
  scene.materials[0].base_color_map = map_of(std::make_shared<const Image>(64, 48, 4, 0.5F));
  scene.materials[0].metallic_roughness_map = map_of(std::make_shared<const Image>(64, 48, 2, 0.5F));
  return scene;
}

TEST(MemoryEstimate, CountsEachMapOnceAndItsChainsForEachMaterial) {
  const MemoryEstimate estimate =
      estimate_memory(two_materials(), effects_of({Effect::normal_variation, Effect::roughness_variation,
                                                   Effect::metallic_variation, Effect::base_color_variation}));
  EXPECT_EQ(estimate.maps, texels * 4 * (4 + 4 + 2));
  EXPECT_EQ(estimate.shared, texels * 4 * (4 + 1) * 4 / 3);
  EXPECT_EQ(estimate.reference, texels * 4 * (2 * 4 + 1));
  EXPECT_EQ(estimate.a_method, texels * 4 * (2 * 4 + 1) * 4 / 3);
  EXPECT_EQ(estimate.bake, 3 * texels * 4 * 4 * 4 / 3);
  EXPECT_EQ(estimate.peak(3) - estimate.peak(1), 2 * estimate.a_method);
}

TEST(MemoryEstimate, EffectsThatAreOffTakeNothing) {
  const MemoryEstimate estimate = estimate_memory(two_materials(), {});
  EXPECT_EQ(estimate.shared + estimate.reference + estimate.a_method, 0U);
  EXPECT_GT(estimate.maps, 0U);
}

}  // namespace
}  // namespace footprint
