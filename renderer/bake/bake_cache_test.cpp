// Bakes on disk: stored bakes come back whole, damaged ones do not come back at all.
#include "renderer/bake/baked_method.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "renderer/image/mipmap.hpp"
#include "tests/support/fresh_folder.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

Prefiltered example(float value = 1.0F) {
  std::vector<std::vector<Image>> layers(3, {Image(2, 1, 4, value), Image(1, 1, 4, value)});
  return {.textures = {make_array_texture("mixture", layers, Storage::fp16, {.set = 1}, TextureFilter::nearest),
                       make_texture("plain", {Image(1, 1, 2, 0.5F)}, Storage::fp32, {})},
          .scalars = {{"scale", 2.0F}},
          .vectors = {{"steps", {{1.0F, 2.0F}, {3.0F, 4.0F}}}},
          .notes = {"one fit of three stopped early"}};
}

std::vector<std::uint8_t> to_bytes(const Prefiltered& prefiltered) {
  std::vector<std::uint8_t> bytes;
  write_bytes(prefiltered, appending_to(bytes));
  return bytes;
}

TEST(PrefilteredFile, ComesBackAsItWas) { EXPECT_EQ(from_bytes(to_bytes(example())), example()); }

// What it is written for: at no time a second copy of it.
TEST(PrefilteredFile, IsWrittenLevelByLevel) {
  const Prefiltered large{.textures = {make_texture("map", mip_chain(Image(64, 64, 4, 0.5F)), Storage::fp32, {})},
                          .scalars = {}};
  std::size_t largest = 0, whole = 0;
  write_bytes(large, [&](std::span<const std::uint8_t> piece) {
    largest = std::max(largest, piece.size());
    whole += piece.size();
  });
  EXPECT_EQ(largest, large.textures[0].levels[0].bytes.size());
  EXPECT_EQ(whole, to_bytes(large).size());
}

TEST(PrefilteredFile, EveryCutAndEveryFlippedBitIsNoticed) {
  const std::vector<std::uint8_t> whole = to_bytes(example());
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_FALSE(from_bytes(std::span(whole).first(length))) << length;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::vector<std::uint8_t> damaged = whole;
    damaged[i] ^= 1U;
    EXPECT_FALSE(from_bytes(damaged)) << i;
  }
}

TEST(BakeCache, TheKeyFollowsEverythingThatABakeDependsOn) {
  const Material material = testing::square_scene(testing::constant_normals(4, 4, {0, 0, 1}), {}).materials[0];
  const std::vector<OptionSpec> specs{number_option("n", 4.0, 1, 8, "lobes")};
  const Options options(specs, {}, "test");
  const std::string key = bake_key("m", material, options, {});
  EXPECT_EQ(bake_key("m", material, options, {}), key);
  EXPECT_NE(bake_key("other", material, options, {}), key);
  EXPECT_NE(bake_key("m", material, Options(specs, {{"n", "5"}}, "test"), {}), key);
  EXPECT_NE(bake_key("m", material, options, EffectSet{}.set()), key);
  Material changed = material;
  changed.roughness *= 0.5F;
  EXPECT_NE(bake_key("m", changed, options, {}), key);
  changed = material;
  changed.normal_map->image = std::make_shared<const Image>(testing::constant_normals(4, 4, {0, 0.6F, 0.8F}));
  EXPECT_NE(bake_key("m", changed, options, {}), key);
  changed = material;
  changed.normal_map->coordinates.wrap[0] = Wrap::clamp_to_edge;
  EXPECT_NE(bake_key("m", changed, options, {}), key);
  changed = material;
  changed.layer_map = material.normal_map;
  EXPECT_NE(bake_key("m", changed, options, {}), key);
}

// A method that counts its precomputes.
struct Counting {
  explicit Counting(bool slow) { method.info.slow_precompute = slow; }

  int count = 0;
  Method method{.info = {.name = "counting", .summary = {}, .paper = {}, .options = {}, .honours = {}},
                .precompute =
                    [this](const Material& /*material*/, const Options& /*options*/, const EffectSet& /*effects*/,
                           const Progress& /*progress*/) {
                      ++count;
                      return example();
                    },
                .shader = {}};
};

TEST(Bake, SlowPrecomputeIsDoneOnce) {
  const DiskCache cache(test::fresh_folder() / "cache");
  const Scene scene = testing::square_scene(testing::constant_normals(4, 4, {0, 0, 1}), {});
  Counting slow(true);
  const MethodSpec spec{.text = "counting", .name = "counting", .options = {}};
  const BakedMethod first = bake(slow.method, spec, scene, {}, no_progress, &cache);
  const BakedMethod second = bake(slow.method, spec, scene, {}, no_progress, &cache);
  EXPECT_EQ(slow.count, 1);
  EXPECT_FALSE(first.cached);
  EXPECT_TRUE(second.cached);
  EXPECT_EQ(first.materials, second.materials);
  EXPECT_EQ(first.bytes, second.bytes);
  const BakedMethod without = bake(slow.method, spec, scene, {}, no_progress);
  EXPECT_EQ(slow.count, 2);
  EXPECT_FALSE(without.cached);
}

TEST(Bake, ADamagedFileCountsAsAbsent) {
  const DiskCache cache(test::fresh_folder() / "cache");
  const Scene scene = testing::square_scene(testing::constant_normals(4, 4, {0, 0, 1}), {});
  Counting slow(true);
  const MethodSpec spec{.text = "counting", .name = "counting", .options = {}};
  (void)bake(slow.method, spec, scene, {}, no_progress, &cache);
  for (const auto& file : fs::directory_iterator(cache.folder())) fs::resize_file(file.path(), 40);
  const BakedMethod again = bake(slow.method, spec, scene, {}, no_progress, &cache);
  EXPECT_EQ(slow.count, 2);
  EXPECT_FALSE(again.cached);
  EXPECT_EQ(again.materials.at(0), example());
}

TEST(Bake, FastPrecomputeIsNotCached) {
  const DiskCache cache(test::fresh_folder() / "cache");
  const Scene scene = testing::square_scene(testing::constant_normals(4, 4, {0, 0, 1}), {});
  Counting fast(false);
  const MethodSpec spec{.text = "counting", .name = "counting", .options = {}};
  (void)bake(fast.method, spec, scene, {}, no_progress, &cache);
  EXPECT_FALSE(bake(fast.method, spec, scene, {}, no_progress, &cache).cached);
  EXPECT_EQ(fast.count, 2);
}

}  // namespace
}  // namespace footprint
