// Texture units and block bindings: what is declared, and what ends with an error.
#include "renderer/pipeline/shader_source.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>
#include <string>
#include <tuple>

#include "renderer/bake/material_maps.hpp"
#include "renderer/core/error.hpp"
#include "renderer/pipeline/base_surface.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/says.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

// The reference's method with textures of its own, and lines in front of its module.
struct Crowded : Method {
  explicit Crowded(int textures, const std::string& lines = {})
      : Method(base_surface()), text(lines + std::string(base_surface().shader.text)) {
    info = {.name = "crowded", .summary = {}, .paper = {}, .options = {}, .honours = EffectSet{}.set()};
    shader.text = text;
    precompute = [textures](const Material& m, const Options& o, const EffectSet& e, const Progress& p) {
      Prefiltered out = base_surface().precompute(m, o, e, p);
      for (int i = 0; i < textures; ++i)
        out.textures.push_back(make_texture("crowd_" + std::to_string(i), {Image(1, 1, 1, 0.5F)}, Storage::fp32, {}));
      return out;
    };
  }

  std::string text;
};

Error error_of(const Method& method) {
  TestRenderer renderer(square_scene(random_normals(4, 4, 0.4F, 7), {}), {8, 8});
  try {
    (void)renderer.frame(method);
  } catch (const Error& error) {
    return error;
  }
  return {ErrorKind::machine, "nothing", "was thrown"};
}

std::string fragment_text(const ShaderVariant& variant, const Prefiltered& prefiltered) {
  return forward_shaders(variant, forward_units(variant, prefiltered), base_surface().shader, Options({}, {}, "test"),
                         prefiltered)
      .fragment.text();
}

// The lights of one kind lie in one uniform block.
TEST(LightBlocks, OneTooManyNamesTheLimit) {
  const auto block = static_cast<std::size_t>(shared_context().info().max_uniform_block_bytes);
  Scene scene = square_scene(random_normals(4, 4, 0.4F, 7), {});
  for (const auto& [light, most, kind] :
       {std::tuple<Light, std::size_t, std::string>{PointLight{}, block / 32, "point"},
        {SpotLight{}, block / 64, "spot"},
        {DirectionalLight{}, block / 32, "directional"},
        {AreaLight{.points = 1}, block / 96, "area"}}) {
    scene.lights.assign(most + 1, light);
    try {
      const GpuScene refused(shared_context().info(), scene, EffectSet{});
      ADD_FAILURE() << most + 1 << " " << kind << " lights are taken";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::machine);
      EXPECT_TRUE(test::says(error.what(), fmt::format("has {} {} lights", most + 1, kind)));
      EXPECT_TRUE(test::says(error.what(), fmt::format("takes {} at once", most)));
    }
    scene.lights.resize(most);
    EXPECT_NO_THROW(GpuScene(shared_context().info(), scene, EffectSet{}));
  }
}

TEST(TextureUnits, AsManyAsTheGlHasAreDrawn) {
  const int most = shared_context().info().max_texture_units;
  EXPECT_EQ(error_of(Crowded(most - 1)).place(), "nothing");  // base_normal is the last
}

TEST(TextureUnits, OneTooManyNamesTheMethodAndTheTextures) {
  const int most = shared_context().info().max_texture_units;
  const Error error = error_of(Crowded(most));
  EXPECT_EQ(error.kind(), ErrorKind::machine);
  EXPECT_EQ(error.place(), "method crowded");
  EXPECT_TRUE(test::says(error.what(), std::to_string(most + 1) + " textures"));
  EXPECT_TRUE(test::says(error.what(), "base_normal, crowd_0"));
}

// A sampler of the module's own would share unit 0 with its texture.
TEST(TextureUnits, ATextureWithoutAUnitIsAnError) {
  const Error error = error_of(Crowded(0, R"(uniform sampler2D stray;
#define fetchFinest(map, footprint) (fetchFinest(map, footprint) + texelFetch(stray, ivec2(0), 0))
)"));
  EXPECT_EQ(error.kind(), ErrorKind::usage);
  EXPECT_EQ(error.place(), "method crowded");
  EXPECT_TRUE(test::says(error.what(), "`stray`"));
}

TEST(TextureUnits, WhatHasNoUnitIsRefused) {
  const TextureUnits units({}, {});
  EXPECT_THROW((void)units.unit("base_color_map"), std::logic_error);
}

TEST(TextureUnits, SharedMapsComeFirstWhereTheirEffectsAreOn) {
  for (const SharedMap& map : shared_maps()) {
    EffectSet effects;
    effects.set(static_cast<std::size_t>(map.effect));
    EXPECT_EQ(TextureUnits(effects, {}).declarations(),
              "layout(binding = 0) uniform sampler2D " + std::string(map.name) + ";\n");
  }
  EXPECT_EQ(TextureUnits({}, {}).declarations(), "");
}

// What the shared shaders read of a material's maps has a row: without one the name would not be declared.
TEST(TextureUnits, EveryMapOfTheSharedShadersHasARow) {
  const std::regex lookup(
      R"(\b(?:texture|textureGrad|textureLod|texelFetch|fetch|fetchCoat)\((\w*_map|material_share),)");
  std::set<std::string> found;
  for (const bool emitting : {false, true}) {
    const std::string text = fragment_text({.effects = EffectSet{}.set(), .brdf = {}, .emitting = emitting}, {});
    for (auto i = std::sregex_iterator(text.begin(), text.end(), lookup); i != std::sregex_iterator(); ++i) {
      found.insert((*i)[1].str());
      EXPECT_TRUE(test::says(text, "sampler2D " + (*i)[1].str() + ";"));
    }
  }
  EXPECT_EQ(found.size(), shared_maps().size());
}

TEST(BlockBindings, AreThoseOfTheShaders) {
  const std::map<std::string, GLuint> expected{{"MaterialBlock", block_binding::material},
                                               {"MethodBlock", block_binding::method},
                                               {"PointLights", light_types[light_type::point].binding},
                                               {"SpotLights", light_types[light_type::spot].binding},
                                               {"DirectionalLights", light_types[light_type::directional].binding},
                                               {"EnvironmentBlock", block_binding::environment},
                                               {"ShadowViews", block_binding::shadow_views},
                                               {"AreaLights", light_types[light_type::area].binding},
                                               {"AreaPoints", light_types[light_type::area_point].binding}};
  const std::string text = fragment_text({.effects = EffectSet{}.set(), .brdf = {}, .lights = {0, 0, 0, 0, 1}},
                                         {.textures = {}, .scalars = {{"own", 1.0F}}});
  std::map<std::string, GLuint> found;
  const std::regex block(R"(layout\(std140, binding = (\d+)\) uniform (\w+))");
  for (auto i = std::sregex_iterator(text.begin(), text.end(), block); i != std::sregex_iterator(); ++i)
    found[(*i)[2].str()] = static_cast<GLuint>(std::stoul((*i)[1].str()));
  EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace footprint::testing
