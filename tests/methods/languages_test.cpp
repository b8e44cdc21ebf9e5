// The module in other shader languages draws the picture of its GLSL: ESSL as Mesa compiles it, SPIR-V through GLSL,
// and HLSL as glslang reads it.
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <regex>

#include "methods/registry.hpp"
#include "renderer/baked_files/baked_files.hpp"
#include "renderer/languages/translation.hpp"
#include "renderer/pipeline/surface_program.hpp"
#include "tests/methods/bare_renderer.hpp"
#include "tests/support/fresh_folder.hpp"
#include "tests/support/hlsl_reader.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/says.hpp"
#include "tests/support/sweep.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

namespace fs = std::filesystem;

constexpr glm::ivec2 drawn_size{32, 32};

std::string content(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// The files of a bake with every language.
fs::path baked_in_all_languages(const Scene& scene, const std::string& text) {
  const MethodSpec spec = parse_methods(text).front();
  const EffectSet effects = effects_on(derive_effects(scene));
  BakedMethod baked = bake(find_method(spec.name), spec, scene, effects, no_progress);
  if (waits_for_build(baked)) take_built_maps(shared_context(), scene, effects, baked);
  const fs::path folder = test::fresh_folder();
  write_bake({.scene = scene,
              .baked = baked,
              .effects = effects,
              .footprint = {FootprintFilterKind::anisotropic, 8},
              .version = "0",
              .languages = {ShaderLanguage::essl, ShaderLanguage::hlsl, ShaderLanguage::msl, ShaderLanguage::spirv}},
             folder);
  return folder;
}

Spirv read_spirv(const fs::path& file) {
  const std::string bytes = content(file);
  Spirv code(bytes.size() / sizeof(Spirv::value_type));
  std::memcpy(code.data(), bytes.data(), bytes.size());
  return code;
}

// The shader of a language as text that OpenGL compiles.
std::string back_to_gl(const fs::path& folder, const std::string& name, ShaderLanguage language) {
  const fs::path file = folder / (name + "." + file_extension(language));
  if (language == ShaderLanguage::spirv) return translate(read_spirv(file), ShaderLanguage::glsl, "");
  const std::string text = content(file);
  return language == ShaderLanguage::hlsl ? test::glsl_of_hlsl(text) : text;
}

void expect_same_picture(const fs::path& folder, const Scene& scene, const std::string& name,
                         const std::vector<ShaderLanguage>& languages) {
  const Image own = render_from_files(folder, scene, drawn_size, MapFiles::ktx2);
  EXPECT_GT(std::ranges::max(own.texels), 0.1F);
  for (const ShaderLanguage language : languages) {
    const Image other =
        render_from_files(folder, scene, drawn_size, MapFiles::ktx2, back_to_gl(folder, name, language));
    EXPECT_LT(largest_difference(other, own), 1e-5) << name << " in " << file_extension(language);
  }
}

constexpr std::array<ShaderLanguage, 3> compiled_again{ShaderLanguage::essl, ShaderLanguage::hlsl,
                                                       ShaderLanguage::spirv};

class Languages : public ::testing::TestWithParam<std::size_t> {};

TEST_P(Languages, DrawThePictureOfTheGlsl) {
  const std::string& name = all_methods()[GetParam()]->info.name;
  const Scene scene = rough_square(16);
  expect_same_picture(baked_in_all_languages(scene, name), scene, name, sweep(compiled_again, 1, GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Registry, Languages, ::testing::Range(std::size_t{0}, all_methods().size()),
                         [](const auto& each) { return all_methods()[each.param]->info.name; });

TEST(LanguagesOf, LeanDrawThePictureOfTheGlsl) {
  const Scene scene = rough_square(16);
  expect_same_picture(baked_in_all_languages(scene, "lean"), scene, "lean",
                      {compiled_again.begin(), compiled_again.end()});
}

// The comparison can fail: it does if one number of a shader differs.
TEST(LanguagesOf, AnotherShaderDrawsAnotherPicture) {
  const Scene scene = rough_square(16);
  const fs::path folder = baked_in_all_languages(scene, "lean");
  std::string shader = content(folder / "lean.essl");
  const std::size_t place = shader.find("uniforms.candela");
  ASSERT_NE(place, std::string::npos);
  shader.insert(place, "1.001 * ");
  const Image own = render_from_files(folder, scene, drawn_size, MapFiles::ktx2);
  EXPECT_GT(largest_difference(render_from_files(folder, scene, drawn_size, MapFiles::ktx2, shader), own), 1e-5);
}

// Debian has no compiler of Metal, so its interface is checked by its text.
TEST(LanguagesOf, MetalHasTheEntryPointAndTheInputs) {
  const fs::path folder = baked_in_all_languages(rough_square(16), "lean");
  const std::string text = content(folder / "lean.msl");
  std::smatch entry;
  ASSERT_TRUE(std::regex_search(text, entry, std::regex(R"(\nfragment main0_out main0\(([^{]*)\)\n\{)")));
  for (const char* part :
       {"main0_in in [[stage_in]]", "constant Uniforms& uniforms [[buffer(0)]]",
        "texture2d<float> slope_moments [[texture(0)]]", "texture2d<float> slope_rest [[texture(1)]]",
        "texture2d<float> lobe_variance [[texture(2)]]", "sampler slope_restSmplr [[sampler(1)]]"})
    EXPECT_TRUE(test::says(entry[1].str(), part)) << part;
  for (const char* part : {"float3 at [[user(locn0)]];", "float2 uv [[user(locn3)]];", "float4 seen [[color(0)]];"})
    EXPECT_TRUE(test::says(text, part)) << part;
  EXPECT_EQ(std::ranges::count(text, '{'), std::ranges::count(text, '}'));
}

TEST(LanguagesOf, FilesListTheInputsAndHaveTheComments) {
  const fs::path folder = baked_in_all_languages(rough_square(16), "lean");
  for (const char* file : {"lean.essl", "lean.hlsl", "lean.msl"}) {
    const std::string text = content(folder / file);
    for (const char* part :
         {"texture 1    sampler2D slope_rest", "attribute 3  vec2 uv: where the maps are looked up",
          "uniform      int footprint_parts: set it to 8", "uniform      vec4 lobe_cutoff: x: the base",
          "// v: slope variance per axis of the base lobe", "// The lobe over the footprint of a pixel."})
      EXPECT_TRUE(test::says(text, part)) << file << ": " << part;
  }
}

TEST(LanguagesOf, CommentsStandAtTheirFunctionsAndMembers) {
  const std::string glsl =
      "// Two.\nstruct Pair {\n  float a;  // first\n};\n// Sums\n// it.\nfloat sum(Pair p) {\n}\nfloat bare() {\n}\n";
  EXPECT_EQ(with_comments(
                "struct Pair\n{\n    float a;\n};\nfloat bare()\n{\n}\nfloat sum(Pair p)\n{\n    float a;\n}\n", glsl),
            "// Two.\nstruct Pair\n{\n    float a;  // first\n};\nfloat bare()\n{\n}\n// Sums\n// it.\nfloat sum(Pair "
            "p)\n{\n    float a;\n}\n");
}

}  // namespace
}  // namespace footprint::testing
