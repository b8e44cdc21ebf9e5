// Heads of methods' files: what they bake, and errors that name the file's own line.
#include "renderer/bake/method_file.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <vector>

#include "renderer/bake/material_maps.hpp"
#include "renderer/bake/normal_chain.hpp"
#include "renderer/bake/slope_moments.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/image/mipmap.hpp"
#include "tests/support/fresh_folder.hpp"
#include "tests/support/says.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint {
namespace {

using test::fresh_folder;
using test::says;

const std::string start = "/*\nname = \"mine\"\nsummary = \"A test.\"\n";

std::filesystem::path written(const std::string& text) {
  std::filesystem::path file = fresh_folder() / "mine.glsl";
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

std::shared_ptr<const Method> method_with(const std::string& head) {
  return read_method_file(written(start + head + "*/\nfloat body;\n").string());
}

std::string error_of_text(const std::string& text) {
  try {
    (void)read_method_file(written(text).string());
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    return error.what();
  }
  return "no error";
}

std::string error_of_head(const std::string& head) { return error_of_text(start + head + "*/\n"); }

// A material with everything that the inputs are baked of.
Material varied_material() {
  Material material = testing::square_scene(testing::random_normals(8, 8, 0.4F, 3), {}).materials.front();
  Image roughness(4, 4, 3, 0.25F);
  for (std::size_t i = 0; i < roughness.texels.size(); ++i) roughness.texels[i] += 0.01F * static_cast<float>(i);
  material.metallic_roughness_map = {"roughness", std::make_shared<const Image>(roughness), {}};
  return material;
}

EffectSet varied_effects() {
  EffectSet effects;
  for (const Effect effect : {Effect::diffuse, Effect::normal_variation, Effect::roughness_variation})
    effects.set(static_cast<std::size_t>(effect));
  return effects;
}

Prefiltered baked_by(const Method& method, const std::map<std::string, std::string>& options = {}) {
  const Options values(method.info.options, options, "mine");
  return method.precompute(varied_material(), values, varied_effects(), no_progress);
}

TEST(MethodFile, DescribesItself) {
  const auto method = method_with(
      "paper = \"None\"\nreads = [\"mean_normal\", \"screen_derivatives\"]\nleaves_out = [\"multi_lobe\"]\n"
      "[[option]]\nname = \"share\"\ndefault = 0.5\nrange = [0, 2]\nmeaning = \"A share.\"\n"
      "[[option]]\nname = \"count\"\ndefault = 3\nrange = [1, 8]\nwhole = true\nmeaning = \"A count.\"\n"
      "[[option]]\nname = \"form\"\nchoices = [\"round\", \"flat\"]\nmeaning = \"A form.\"\n");
  EXPECT_EQ(method->info.name, "mine");
  EXPECT_EQ(method->info.paper, "None");
  EXPECT_TRUE(method->info.screen_derivatives);
  EXPECT_FALSE(has(method->info.honours, Effect::multi_lobe));
  EXPECT_FALSE(has(method->info.honours, Effect::tabulated_brdf));
  EXPECT_TRUE(has(method->info.honours, Effect::environment_light));
  ASSERT_EQ(method->info.options.size(), 4U);
  EXPECT_EQ(method->info.options[0].name, "storage");
  const Options options(method->info.options, {{"share", "2"}, {"form", "flat"}}, "mine");
  EXPECT_EQ(options.number("share"), 2.0);
  EXPECT_EQ(options.number("count"), 3.0);
  EXPECT_EQ(options.word("form"), "flat");
  EXPECT_THROW(Options(method->info.options, {{"share", "2.5"}}, "mine"), Error);
  EXPECT_THROW(Options(method->info.options, {{"count", "1.5"}}, "mine"), Error);
}

// Against the bakes themselves, put together here.
TEST(MethodFile, BakesWhatItReads) {
  const Material material = varied_material();
  const EffectSet effects = varied_effects();
  std::vector<PrefilteredTexture> wanted = bake_mean_normal(material, Storage::fp16, effects).textures;
  append(wanted, bake_lobe_variance(material, Storage::fp16, effects, RoughnessMean::concentration).textures);
  wanted.push_back(make_texture("mean_roughness", mip_chain(roughness_map_of(material)), Storage::fp16, {}));
  wanted.push_back(make_texture("mean_lobe", mip_chain(lobe_parameter_map_of(material)), Storage::fp16, {}));
  wanted.push_back(make_level_texture("finest_roughness", roughness_map_of(material), Storage::fp16, {}));
  wanted.push_back(make_level_texture("finest_normal", normal_map_of(material), Storage::fp16, {}));
  const auto method = method_with(
      "reads = [\"mean_normal\", \"lobe_variance\", \"mean_roughness\", \"mean_lobe\", \"finest_roughness\", "
      "\"finest_normal\"]\n");
  EXPECT_EQ(baked_by(*method, {{"storage", "fp16"}, {"roughness_mean", "concentration"}}).textures, wanted);
  EXPECT_TRUE(method->precompute(material, Options(method->info.options, {}, ""), {}, no_progress).textures.empty());
  EXPECT_THROW((void)baked_by(*method, {{"storage", "unorm8"}}), Error) << "bytes store no lobe parameter";
  EXPECT_THROW((void)baked_by(*method, {{"storage", "bc1"}}), Error) << "finest_normal has no blocks";
}

TEST(MethodFile, BakesBlocksOfDirections) {
  const auto storages = [](const char* reads, const char* storage) {
    std::vector<Storage> out;
    for (const PrefilteredTexture& t : baked_by(*method_with(reads), {{"storage", storage}}).textures)
      out.push_back(t.storage);
    return out;
  };
  const char* const direction = "reads = [\"mean_direction\", \"mean_roughness\", \"finest_roughness\"]\n";
  EXPECT_EQ(storages(direction, "bc5"), (std::vector{Storage::bc5, Storage::bc4, Storage::bc4}));
  EXPECT_EQ(storages(direction, "bc1"), (std::vector{Storage::bc1, Storage::bc4, Storage::bc4}));
  EXPECT_THROW((void)storages("reads = [\"mean_normal\"]\n", "bc5"), Error) << "its length has no channel";
  EXPECT_THROW((void)storages("reads = [\"mean_direction\", \"mean_lobe\"]\n", "bc1"), Error);
}

TEST(MethodFile, BakesSlopeMomentsAsLeanDoes) {
  const auto method = method_with("reads = [\"mean_normal\", \"slope_moments\"]\n");
  const Options options({float_storage_option(), slope_roughness_option(), steepest_slope_option()},
                        {{"steepest", "2"}}, "test");
  std::vector<PrefilteredTexture> wanted =
      bake_mean_normal(varied_material(), Storage::fp32, varied_effects()).textures;
  append(wanted, bake_slopes(varied_material(), options, varied_effects(), {.mean_normal = true}).textures);
  EXPECT_EQ(baked_by(*method, {{"steepest", "2"}}).textures, wanted);
  EXPECT_THROW((void)baked_by(*method, {{"storage", "unorm8"}}), Error) << "bytes store no moments";
}

TEST(MethodFile, BakesAnInputOnlyUnderItsCondition) {
  const auto method = method_with(
      "reads = [\"mean_roughness if of_roughness\", \"mean_lobe if of_lobe\"]\n"
      "[[option]]\nname = \"of\"\nchoices = [\"roughness\", \"lobe\"]\nmeaning = \"Of what.\"\n");
  EXPECT_EQ(baked_by(*method).textures.at(0).name, "mean_roughness");
  EXPECT_EQ(baked_by(*method).textures.size(), 1U);
  EXPECT_EQ(baked_by(*method, {{"of", "lobe"}}).textures.at(0).name, "mean_lobe");
}

TEST(MethodFile, ReadsImagesWithTheirFilters) {
  const std::filesystem::path file =
      written(start +
              "[[image]]\nname = \"noise\"\nfile = \"noise.exr\"\nfilter = \"trilinear\"\n"
              "[[image]]\nname = \"table\"\nfile = \"noise.exr\"\nfilter = \"linear\"\n*/\n");
  Image noise(2, 2, 1);
  noise.texels = {0.0F, 0.25F, 0.5F, 1.25F};
  write_exr(file.parent_path() / "noise.exr", noise);
  const auto method = read_method_file("mine.glsl", file.parent_path());
  const auto textures = baked_by(*method).textures;
  ASSERT_EQ(textures.size(), 2U);
  EXPECT_EQ(decode_level(textures[0], 1).texels, std::vector<float>{0.5F});
  EXPECT_EQ(textures[0].filter, TextureFilter::trilinear);
  EXPECT_EQ(textures[1].levels.size(), 1U);
  EXPECT_EQ(textures[1].filter, TextureFilter::linear);
  noise.texels[0] = 1.0F;
  write_exr(file.parent_path() / "noise.exr", noise);
  EXPECT_NE(read_method_file("mine.glsl", file.parent_path())->file_content, method->file_content);
}

TEST(MethodFile, IsKnownByItsContent) {
  const std::string content = method_with("paper = \"a\"\n")->file_content;
  EXPECT_EQ(method_with("paper = \"a\"\n")->file_content, content);
  EXPECT_NE(method_with("paper = \"b\"\n")->file_content, content);
}

TEST(MethodFile, NamesTheLineOfAWrongHead) {
  EXPECT_TRUE(says(error_of_head("sumary = \"x\"\n"), "mine.glsl:4: unknown key `sumary` (did you mean `summary`?"));
  EXPECT_TRUE(says(error_of_head("reads = [\"mean_normals\"]\n"), "mine.glsl:4: `reads` has `mean_normals`"));
  EXPECT_TRUE(says(error_of_head("reads = [\"mean_lobe if of_lobe\"]\n"), "mine.glsl:4: `reads` has the condition"));
  EXPECT_TRUE(says(error_of_head("leaves_out = [\"fresnell\"]\n"), "mine.glsl:4: `leaves_out` cannot be taken"));
  EXPECT_TRUE(says(error_of_head("\nname = 3\n"), "mine.glsl:5: not valid TOML"));
  EXPECT_TRUE(says(error_of_text("/*\nsummary = \"x\"\n*/\n"), "`name` is missing"));
  EXPECT_TRUE(says(error_of_text("/* name = \"My\"\nsummary = \"x\" */\n"), "mine.glsl:1: `name` is `My`"));
  EXPECT_TRUE(says(error_of_text("float body;\n"), "mine.glsl:1: does not start with a head"));
  EXPECT_TRUE(says(error_of_text("/* name = \"x\"\n"), "mine.glsl:1: does not start with a head"));
}

TEST(MethodFile, NamesTheLineOfAWrongOptionOrImage) {
  const std::string option = "[[option]]\nname = \"a\"\nmeaning = \"m\"\n";
  EXPECT_TRUE(
      says(error_of_head(option + "default = 3\nrange = [0, 2]\n"), "mine.glsl:7: `default` in [[option]] is 3"));
  EXPECT_TRUE(says(error_of_head(option + "default = 3\n"), "mine.glsl:4: `range` in [[option]] is missing"));
  EXPECT_TRUE(says(error_of_head(option + "range = [2, 1]\ndefault = 1\n"), "mine.glsl:7: `range`"));
  EXPECT_TRUE(says(error_of_head(option + "choices = [\"a b\"]\n"), "mine.glsl:7: `choices`"));
  EXPECT_TRUE(says(error_of_head(option + "choices = [\"a\"]\nwhole = true\n"), "mine.glsl:8: `whole`"));
  EXPECT_TRUE(says(error_of_head("reads = [\"mean_normal\"]\n[[option]]\nname = \"storage\"\nmeaning = \"m\"\n"
                                 "choices = [\"a\"]\n"),
                   "mine.glsl:6: `name` in [[option]] is `storage`, which comes with `reads`"));
  EXPECT_TRUE(says(error_of_head("[[image]]\nname = \"n\"\nfile = \"none.png\"\nfilter = \"linear\"\n"),
                   "mine.glsl:6: `file` in [[image]] cannot be taken"));
  EXPECT_TRUE(says(error_of_head("[[image]]\nname = \"n\"\nfile = \"none.png\"\nfilter = \"cubic\"\n"),
                   "mine.glsl:7: `filter` in [[image]] cannot be taken"));
}

TEST(MethodFile, RefusesWhatIsNoText) {
  EXPECT_TRUE(
      says(error_of_text(start + "*/\n\n" + std::string(1, '\0') + "\n"), "mine.glsl:6: byte 0x00 is not text"));
  EXPECT_TRUE(says(error_of_text(start + "*/\n" + std::string(300 << 10, ' ')), "more than the 262144 that are read"));
  EXPECT_TRUE(says(error_of_text(""), "mine.glsl: the file is empty"));
  EXPECT_THROW((void)read_method_file("missing.glsl", fresh_folder()), Error);
  EXPECT_THROW((void)read_method_file("/dev/zero"), Error);
}

}  // namespace
}  // namespace footprint
