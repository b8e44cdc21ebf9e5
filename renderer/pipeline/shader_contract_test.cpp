// What a module must define: the functions of method_contract.glsl and of the texts that it includes, with their types.
#include "renderer/pipeline/shader_contract.hpp"

#include <gtest/gtest.h>

#include <string>

#include "renderer/core/error.hpp"
#include "renderer/pipeline/shader_source.hpp"

namespace footprint {
namespace {

constexpr std::string_view whole =
    "struct Effective {\n  float lobe;\n};\n"
    "Effective effective(const Footprints at) { return Effective(0.5); }\n"
    "Reflected shade(in Effective e, Surface s,\n                vec3 wi, vec3) {\n  return Reflected(vec3(0.0), "
    "vec3(0.0));\n}\n"
    "float ndf(Effective e, vec3 h) { return 1.0; }\n";

std::string without(std::string_view part) {
  std::string text(whole);
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return text.replace(at, part.size(), "");
}

std::string instead(std::string_view part, std::string_view other) {
  std::string text(whole);
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return text.replace(at, part.size(), other);
}

// The error of a module's forward pass; an empty message if there is none.
Error breach(std::string_view module, const ShaderVariant& variant = {}) {
  try {
    const ForwardShaders shaders =
        forward_shaders(variant, forward_units(variant, {}), {"mine.glsl", module}, Options({}, {}, "t"), {});
    require_definitions(shaders.fragment, "mine.glsl");
  } catch (const Error& error) {
    return error;
  }
  return {ErrorKind::check, {}, {}};
}

ShaderVariant with(Effect effect) {
  ShaderVariant variant;
  variant.effects.set(static_cast<std::size_t>(effect));
  return variant;
}

TEST(ShaderContract, AModuleThatDefinesAllPasses) { EXPECT_EQ(breach(whole).message(), ""); }

TEST(ShaderContract, NamesTheMissingFunction) {
  const Error error = breach(without("float ndf(Effective e, vec3 h) { return 1.0; }\n"));
  EXPECT_EQ(error.kind(), ErrorKind::usage);
  EXPECT_EQ(error.place(), "mine.glsl");
  EXPECT_EQ(error.message(), "does not define `float ndf(Effective e, vec3 h)`");
  EXPECT_TRUE(error.hint().starts_with("renderer/shaders/method_contract.glsl declares it on line ")) << error.hint();
  EXPECT_EQ(breach("\n").message(), "does not define `struct Effective`");
  EXPECT_EQ(breach("struct Effective {\n  float x;\n};\n").message(),
            "does not define `Effective effective(Footprints f)`");
}

// What is only a comment, a call or a prototype defines nothing.
TEST(ShaderContract, CountsDefinitionsAlone) {
  constexpr std::string_view definition = "float ndf(Effective e, vec3 h) { return 1.0; }";
  for (const char* const other :
       {"// float ndf(Effective e, vec3 h) { return 1.0; }", "float ndf(Effective e, vec3 h);",
        "/* float ndf(Effective e,\n vec3 h) { return 1.0; } */",
        "float g(Effective e) {\n  return ndf(e, vec3(0.0));\n}"})
    EXPECT_EQ(breach(instead(definition, other)).message(), "does not define `float ndf(Effective e, vec3 h)`")
        << other;
}

TEST(ShaderContract, ComparesTypes) {
  const auto is_refused = [](std::string_view part, std::string_view other, const std::string& message, int line) {
    const Error error = breach(instead(part, other));
    EXPECT_EQ(error.message(), message) << other;
    EXPECT_EQ(error.place(), "mine.glsl, line " + std::to_string(line)) << other;
  };
  is_refused("float ndf(", "vec3 ndf(",
             "defines `vec3 ndf(Effective e, vec3 h)` instead of `float ndf(Effective e, vec3 h)`", 9);
  is_refused("Effective e, vec3 h", "Effective e, vec2 h",
             "defines `float ndf(Effective e, vec2 h)` instead of `float ndf(Effective e, vec3 h)`", 9);
  is_refused("const Footprints at", "inout Footprints at",
             "defines `Effective effective(inout Footprints at)` instead of `Effective effective(Footprints f)`", 4);
  is_refused("vec3 wi, vec3)", "vec3 wi)",
             "defines `Reflected shade(in Effective e, Surface s, vec3 wi)` instead of `Reflected shade(Effective e, "
             "Surface s, vec3 wi, vec3 wo)`",
             5);
}

// A module with lobes lists them where light is integrated over lobes. What no text calls may be missing: meanNormal.
TEST(ShaderContract, FollowsTheFlags) {
  const ShaderVariant environment = with(Effect::environment_light);
  EXPECT_EQ(breach(whole, environment).message(), "does not define `int lobeCount(Effective e)`");
  const std::string lobes =
      std::string(whole) +
      "int lobeCount(Effective e) { return 1; }\n"
      "NormalLobe normalLobe(Effective e, int i) { return baseNormalLobe(vec3(0.0), 1.0, 1.0); }\n"
      "float lobeGeometry(Effective e, NormalLobe l, vec3 h, vec3 i, vec3 o) { return 1.0; }\n";
  EXPECT_EQ(breach(lobes, environment).message(), "");
  EXPECT_EQ(breach(lobes + "vec3 meanNormal(Effective e) { return vec3(0.0); }\n", environment).message(), "");
}

// The reference alone draws directions; a dense environment is a sum over directional lights.
TEST(ShaderContract, NoMethodDrawsDirectionsForADenseEnvironment) {
  ShaderVariant dense = with(Effect::environment_light);
  dense.environment = EnvironmentUse::dense;
  EXPECT_EQ(breach(whole, dense).message(), "");
  dense.environment = EnvironmentUse::sampled;
  EXPECT_EQ(breach(whole, dense).message(), "does not define `vec3 drawDirection(Effective e, vec3 wo, vec3 u)`");
}

// Texts that a module includes call functions of it too.
TEST(ShaderContract, IncludesWhatSharedTextsCallFor) {
  const std::string text = without(
      "Reflected shade(in Effective e, Surface s,\n                vec3 wi, vec3) {\n  return Reflected(vec3(0.0), "
      "vec3(0.0));\n}\n");
  const Error error = breach(text + "#include \"density_module.glsl\"\n");
  EXPECT_EQ(error.place(), "mine.glsl");
  EXPECT_EQ(error.message(), "does not define `float reflectedDensity(Effective e, vec3 h, vec3 wi, vec3 wo)`");
  EXPECT_TRUE(error.hint().starts_with("renderer/shaders/density_module.glsl")) << error.hint();
}

}  // namespace
}  // namespace footprint
