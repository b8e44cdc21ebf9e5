// The directives of the shader text.
#include "renderer/pipeline/shader_source.hpp"

#include <gtest/gtest.h>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

TEST(SelectText, KeepsWhatIsOn) {
  constexpr std::string_view text = "a\n//? if x\nb\n//? if not y\nc\n//? else\nd\n//? end\n//? else\ne\n//? end\nf\n";
  EXPECT_EQ(select_text(text, {"x"}, "t"), "a\nb\nc\nf\n");
  EXPECT_EQ(select_text(text, {"x", "y"}, "t"), "a\nb\nd\nf\n");
  EXPECT_EQ(select_text(text, {"y"}, "t"), "a\ne\nf\n");
  EXPECT_EQ(select_text(text, {}, "t"), "a\ne\nf\n");
}

TEST(SelectText, NamesFileAndLineOfABadDirective) {
  for (const std::string_view text :
       {"a\n//? iff x\n", "a\n//? end\n", "a\n//? else\n", "a\n//? include none.glsl\n"}) {
    try {
      (void)select_text(text, {}, "module.glsl");
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      EXPECT_EQ(error.place(), "module.glsl, line 2");
    }
  }
  EXPECT_THROW((void)select_text("//? if x\n", {}, "t"), Error);
}

TEST(SelectText, KeepsLineNumbersWhereAsked) {
  EXPECT_EQ(select_text("a\n//? if x\nb\n//? end\nc\n", {}, "t", true), "#line 1\na\n#line 3\n#line 5\nc\n");
}

TEST(SelectText, TakesInASharedTextWhereItsFlagIsOn) {
  constexpr std::string_view text = "a\n//? if x\n//? include beckmann_lambda.glsl\n//? end\nb\n";
  EXPECT_EQ(select_text(text, {}, "t"), "a\nb\n");
  const std::string taken = select_text(text, {"x"}, "t", true);
  EXPECT_TRUE(taken.starts_with("#line 1\na\n#line 3\n#line 10001\n//")) << taken;
  EXPECT_TRUE(taken.ends_with("#endif\n#line 4\n#line 5\nb\n")) << taken;
}

TEST(ShaderFlags, FollowEffectsTermsAndWordOptions) {
  const std::vector<OptionSpec> specs{word_option("storage", {"fp32", "fp16"}, "")};
  ShaderVariant variant;
  variant.effects.set(static_cast<std::size_t>(Effect::fresnel));
  variant.max_probes = 4;
  const ShaderFlags flags = shader_flags(variant, Options(specs, {{"storage", "fp16"}}, "t"));
  EXPECT_EQ(flags, (ShaderFlags{"fresnel", "fresnel_schlick", "distribution_ggx", "geometry_smith", "sampling_frame",
                                "anisotropic", "storage_fp16"}));
}

}  // namespace
}  // namespace footprint
