// The estimate of what a scene's maps take, worked out by hand.
#include "experiments/studies/memory_estimate.hpp"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <optional>

namespace footprint {
namespace {

const std::array<NormalMemory, 1> as_lean{[](const Material& /*material*/) { return std::nullopt; }};

// Of methods that take so much for every normal map.
NormalMemory takes(std::uint64_t kept, std::uint64_t baking) {
  return [=](const Material& /*material*/) { return BakeMemory{.kept = kept, .baking = baking}; };
}

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

TEST(MemoryEstimate, CountsEachMapOnceAndItsChainsForEachPairOfMaps) {
  const MemoryEstimate estimate =
      estimate_memory(two_materials(),
                      effects_of({Effect::normal_variation, Effect::roughness_variation, Effect::metallic_variation,
                                  Effect::base_color_variation}),
                      as_lean);
  EXPECT_EQ(estimate.maps, texels * 4 * (4 + 4 + 2));
  EXPECT_EQ(estimate.shared, texels * 4 * (4 + 1) * 4 / 3);
  EXPECT_EQ(estimate.reference, texels * 4 * (4 + 1));
  EXPECT_EQ(estimate.methods.front().kept, texels * 4 * (2 * 8 + 1) * 4 / 3);
  EXPECT_EQ(estimate.methods.front().baking, texels * 4 * (8 + 1 + 2 * 8) * 4 / 3)
      << "the first material's chains, and what LEAN keeps of the second's, twice";
  EXPECT_EQ(estimate.upload, texels * 4 * 4);
  EXPECT_EQ(estimate.peak(), estimate.kept + estimate.shared + estimate.methods.front().baking);
}

TEST(MemoryEstimate, GoesByWhatEachMethodTakesForNormals) {
  const EffectSet normals = effects_of({Effect::normal_variation});
  const std::array<NormalMemory, 3> methods{takes(100'000, 300'000), takes(400'000, 2'000'000), takes(0, 0)};
  const MemoryEstimate estimate = estimate_memory(two_materials(), normals, methods);
  EXPECT_EQ(estimate.methods, (std::vector<BakeMemory>{{100'000, 300'000}, {400'000, 2'000'000}, {0, 0}}));
  EXPECT_EQ(estimate.bake_order(), (std::vector<std::size_t>{1, 0, 2}));
  EXPECT_EQ(estimate.peak(), estimate.kept + 2'000'000) << "by the first, before the others are there";
  const MemoryEstimate first = estimate_memory(two_materials(), normals, std::span(methods).first(1));
  EXPECT_EQ(first.peak(), first.kept + 300'000);
  EXPECT_EQ(estimate_memory(two_materials(), normals, std::span(methods).last(1)).peak(),
            estimate.kept + estimate.reference + estimate.upload);
}

// Two maps of one material each: the second is baked when what is kept of the first lies on the GPU.
TEST(MemoryEstimate, CountsWhatEarlierMaterialsLeft) {
  Scene scene = two_materials();
  scene.materials[1].normal_map = map_of(std::make_shared<const Image>(64, 48, 4, 0.25F));
  const std::array<NormalMemory, 1> method{takes(100'000, 300'000)};
  const MemoryEstimate estimate = estimate_memory(scene, effects_of({Effect::normal_variation}), method);
  EXPECT_EQ(estimate.methods.front(), (BakeMemory{.kept = 200'000, .baking = 400'000}));
}

TEST(MemoryEstimate, CountsWhatMaterialsShareOnce) {
  Scene scene = two_materials();
  const EffectSet normals = effects_of({Effect::normal_variation});
  const MemoryEstimate shared = estimate_memory(scene, normals, as_lean);
  EXPECT_EQ(shared.methods.front().kept, texels * 4 * 8 * 4 / 3);
  scene.materials[1].normal_map = map_of(std::make_shared<const Image>(64, 48, 4, 0.25F));
  const MemoryEstimate apart = estimate_memory(scene, normals, as_lean);
  EXPECT_EQ(apart.methods.front().kept, 2 * shared.methods.front().kept);
  EXPECT_EQ(apart.reference, 2 * shared.reference);
}

// Noise of 8 bits: a quarter of its floats, and a table of its values for each channel.
TEST(MemoryEstimate, CountsWhatIsKeptAtItsOwnDepth) {
  Image noise(64, 48, 4);
  for (std::size_t i = 0; i < noise.texels.size(); ++i)
    noise.texels[i] = static_cast<float>((i * i + 7 * i) % 251) / 255.0F;
  Scene scene = two_materials();
  const MemoryEstimate floats = estimate_memory(scene, {}, as_lean);
  EXPECT_EQ(floats.kept, floats.maps);
  scene.materials[0].base_color_map->image = MapTexels::packed(noise);
  const MemoryEstimate packed = estimate_memory(scene, {}, as_lean);
  EXPECT_EQ(packed.maps, floats.maps);
  EXPECT_LE(packed.kept, floats.kept - 3 * texels * 4 + 4 * 256 * sizeof(float));
  EXPECT_EQ(floats.peak() - packed.peak(), floats.kept - packed.kept);
}

TEST(MemoryEstimate, CountsTheMapsOfCoats) {
  Scene scene = two_materials();
  scene.materials[1].coat = ClearCoat{};
  scene.materials[1].coat->weight_map = map_of(std::make_shared<const Image>(64, 48, 1, 0.5F));
  scene.materials[1].coat->roughness_map = map_of(std::make_shared<const Image>(64, 48, 1, 0.25F));
  scene.materials[1].coat->normal_map = map_of(std::make_shared<const Image>(64, 48, 4, 0.75F));
  const MemoryEstimate estimate = estimate_memory(
      scene, effects_of({Effect::coat_weight_variation, Effect::coat_width_variation, Effect::coat_normal_variation}),
      as_lean);
  EXPECT_EQ(estimate.maps - estimate_memory(two_materials(), {}, as_lean).maps, texels * 4 * (1 + 1 + 4));
  EXPECT_EQ(estimate.shared, texels * 4 * (1 + 1 + 3) * 4 / 3);
  EXPECT_EQ(estimate.peak(), estimate.kept + estimate.shared + texels * 4 * 3 * 4 * 4 / 3);
}

TEST(MemoryEstimate, EffectsThatAreOffTakeNothing) {
  const MemoryEstimate estimate = estimate_memory(two_materials(), {}, as_lean);
  EXPECT_EQ(estimate.shared + estimate.reference + estimate.methods.front().baking, 0U);
  EXPECT_GT(estimate.maps, 0U);
}

}  // namespace
}  // namespace footprint
