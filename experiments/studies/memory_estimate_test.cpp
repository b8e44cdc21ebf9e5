// The estimate of what a scene's maps take, worked out by hand.
#include "experiments/studies/memory_estimate.hpp"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <optional>

namespace footprint {
namespace {

constexpr std::array<std::optional<int>, 1> as_lean{std::nullopt};

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
  EXPECT_EQ(estimate.methods.front(), texels * 4 * (2 * 8 + 1) * 4 / 3);
  EXPECT_EQ(estimate.bake, 2 * texels * 4 * 8 * 4 / 3) << "what LEAN keeps, twice";
  EXPECT_EQ(estimate.upload, texels * 4 * 4);
  EXPECT_EQ(estimate.peak(),
            estimate.kept + estimate.shared + estimate.methods.front() + estimate.reference + estimate.upload);
}

TEST(MemoryEstimate, GoesByWhatEachMethodKeepsOfNormals) {
  const EffectSet normals = effects_of({Effect::normal_variation});
  const std::array<std::optional<int>, 3> methods{std::nullopt, 3, 0};
  const MemoryEstimate estimate = estimate_memory(two_materials(), normals, methods);
  const std::uint64_t a_channel = texels * 4 * 4 / 3;
  EXPECT_EQ(estimate.methods, (std::vector<std::uint64_t>{8 * a_channel, 3 * a_channel, 0}));
  EXPECT_EQ(estimate.peak(), estimate.kept + 11 * a_channel + estimate.bake);
  EXPECT_EQ(estimate_memory(two_materials(), normals, std::span(methods).subspan(1, 1)).bake, 3 * 4 * a_channel)
      << "less than a copy of the map, its levels and these as they are uploaded";
  const MemoryEstimate first_two = estimate_memory(two_materials(), normals, std::span(methods).first(2));
  EXPECT_EQ(first_two.peak(), estimate.kept + 8 * a_channel + estimate.bake)
      << "the last one's chains are not made yet";
}

TEST(MemoryEstimate, CountsWhatMaterialsShareOnce) {
  Scene scene = two_materials();
  const EffectSet normals = effects_of({Effect::normal_variation});
  const MemoryEstimate shared = estimate_memory(scene, normals, as_lean);
  EXPECT_EQ(shared.methods.front(), texels * 4 * 8 * 4 / 3);
  scene.materials[1].normal_map = map_of(std::make_shared<const Image>(64, 48, 4, 0.25F));
  const MemoryEstimate apart = estimate_memory(scene, normals, as_lean);
  EXPECT_EQ(apart.methods.front(), 2 * shared.methods.front());
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

TEST(MemoryEstimate, EffectsThatAreOffTakeNothing) {
  const MemoryEstimate estimate = estimate_memory(two_materials(), {}, as_lean);
  EXPECT_EQ(estimate.shared + estimate.reference + estimate.methods.front(), 0U);
  EXPECT_GT(estimate.maps, 0U);
}

}  // namespace
}  // namespace footprint
