// The flags of a variant: all that texts may test, and which of them are on.
#include "renderer/pipeline/shader_flags.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "renderer/core/error.hpp"
#include "renderer/pipeline/shader_source.hpp"

namespace footprint {
namespace {

std::set<std::string> on(const ShaderFlags& flags) {
  std::set<std::string> names;
  for (const auto& [name, is_on] : flags) {
    if (is_on) names.insert(name);
  }
  return names;
}

TEST(ShaderFlags, FollowEffectsTermsAndWordOptions) {
  const std::vector<OptionSpec> specs{word_option("storage", {"fp32", "fp16"}, ""), number_option("n", 1, 0, 2, "")};
  ShaderVariant variant;
  variant.effects.set(static_cast<std::size_t>(Effect::fresnel));
  variant.footprint = {FootprintFilterKind::anisotropic, 4};
  const ShaderFlags flags = shader_flags(variant, Options(specs, {{"storage", "fp16"}}, "t"));
  EXPECT_EQ(on(flags),
            (std::set<std::string>{"fresnel", "fresnel_schlick", "distribution_ggx", "geometry_smith", "sampling_frame",
                                   "filter_anisotropic", "several_probes", "storage_fp16"}));
}

// Flags that are off are known too, so that texts may test them.
TEST(ShaderFlags, KnowWhatIsOff) {
  const std::vector<OptionSpec> specs{word_option("storage", {"fp32", "fp16"}, "")};
  const ShaderFlags flags = shader_flags({}, Options(specs, {}, "t"));
  for (const std::string& effect : effect_names(EffectSet{}.set())) EXPECT_TRUE(flags.contains(effect)) << effect;
  for (const char* name : {"distribution_vmf", "geometry_tan", "sampling_texel", "texture_arrays", "storage_fp16"}) {
    ASSERT_TRUE(flags.contains(name)) << name;
    EXPECT_FALSE(flags.at(name)) << name;
  }
  EXPECT_FALSE(flags.contains("storage_unorm8"));
}

TEST(ShaderFlags, RefuseAnOptionWithAFlagOfTheirOwn) {
  const std::vector<OptionSpec> specs{word_option("filter", {"box", "tent"}, "")};
  EXPECT_THROW((void)shader_flags({}, Options(specs, {}, "t")), Error);
}

TEST(ShaderFlags, FollowTextures) {
  const Options options({}, {}, "t");
  Prefiltered textures;
  textures.textures.push_back(make_texture("map", {Image(1, 1, 1)}, Storage::fp32, {}));
  EXPECT_FALSE(shader_flags({}, options, textures).at("texture_arrays"));
  const std::vector<std::vector<Image>> layers{{Image(1, 1, 1)}};
  textures.textures.push_back(make_array_texture("maps", layers, Storage::fp32, {}, TextureFilter::nearest));
  EXPECT_TRUE(shader_flags({}, options, textures).at("texture_arrays"));
  EXPECT_TRUE(shader_flags({}, options, textures).at("texel_lookups"));
}

// Modules divide by it what llvmpipe allows a pixel.
TEST(ShaderSource, CountsTheCallsOfAPixel) {
  ShaderVariant variant;
  const auto has_calls = [&](int count) {
    const std::string text =
        forward_shaders(variant, forward_units(variant, {}), {"m.glsl", "\n"}, Options({}, {}, "t"), {})
            .fragment.text();
    return text.find("const int shade_calls = " + std::to_string(count) + ";") != std::string::npos;
  };
  EXPECT_TRUE(has_calls(1)) << "no light";
  variant.lights[light_type::point] = 2;
  variant.lights[light_type::directional] = 1;
  variant.environment_suns = 2;
  EXPECT_TRUE(has_calls(5));
  variant.footprint = {FootprintFilterKind::anisotropic, 8};
  EXPECT_TRUE(has_calls(5));
  variant.footprint = {FootprintFilterKind::shaded, 3};
  EXPECT_TRUE(has_calls(45));
}

}  // namespace
}  // namespace footprint
