// Surfaces as the loader meets them: a library of two made-up ones, named in scene.toml.
#include "renderer/scene/surface.hpp"

#include <gtest/gtest.h>

#include "renderer/scene/assembly/load_scene.hpp"
#include "renderer/scene/geometry.hpp"
#include "tests/support/gltf_builder.hpp"

namespace footprint {
namespace {

Mesh field(const SurfaceSettings& /*settings*/) { return make_plane({2.0F, 2.0F}, {1.0F, 1.0F}); }

/// Flat but for x, which stores the seed and a parameter for the test.
Image marked(const SurfaceSettings& settings) {
  Image map(settings.resolution, settings.resolution, 4, 1.0F);
  map.at(0, 0)[0] = static_cast<float>(settings.seed);
  map.at(0, 0)[1] = static_cast<float>(settings.parameters.number("height"));
  map.at(0, 0)[2] = settings.parameters.word("kind") == "round" ? 0.5F : 0.25F;
  return map;
}

Image green(const SurfaceSettings& settings) { return {settings.resolution, settings.resolution, 4, 0.5F}; }

std::vector<Surface> hills_and_lawn() {
  const std::vector<OptionSpec> parameters{number_option("height", 2.0, 0, 10, "a number"),
                                           whole_option("count", 3, 1, 9, "a whole number"),
                                           word_option("kind", {"sharp", "round"}, "a word")};
  return {{.name = "hills",
           .summary = "",
           .parameters = parameters,
           .default_resolution = 8,
           .normals = marked,
           .mesh = field},
          {.name = "lawn",
           .summary = "",
           .parameters = parameters,
           .default_resolution = 4,
           .normals = marked,
           .base_color = green,
           .mesh = field}};
}

Scene load_surface(const std::string& settings) {
  static const std::vector<Surface> surfaces = hills_and_lawn();
  return load_scene(test::write_file("made/scene.toml", settings).string(), {.folder = {}, .surfaces = surfaces});
}

TEST(SurfaceInScene, ComesWithMapMeshAndMaterial) {
  const Scene scene = load_surface("[surface]\nname = \"hills\"\n[tiling]\nuv = [3, 5]\n");
  ASSERT_EQ(scene.materials.size(), 1U);
  const Material& material = scene.materials.front();
  EXPECT_EQ(material.name, "hills");
  EXPECT_EQ(material.metallic, 0.0F);
  EXPECT_FALSE(material.base_color_map);
  ASSERT_TRUE(material.normal_map);
  EXPECT_EQ(material.normal_map->image.width(), 8);
  EXPECT_EQ(material.normal_map->image.decoded().at(0, 0)[0], 1.0F);
  EXPECT_EQ(material.normal_map->image.decoded().at(0, 0)[1], 2.0F);
  EXPECT_EQ(material.normal_map->image.decoded().at(0, 0)[2], 0.25F);
  EXPECT_EQ(material.normal_map->coordinates.transform * glm::vec3(1, 1, 1), glm::vec2(3, 5));
  EXPECT_EQ(scene.meshes.front().vertices.size(), 4U);
  EXPECT_TRUE(scene.warnings.empty());
}

TEST(SurfaceInScene, EverySettingIsRead) {
  const Scene scene = load_surface(
      "[surface]\nname = \"lawn\"\nresolution = 33\nseed = 4294967295\n"
      "[surface.parameters]\nheight = 0.75\ncount = 9\nkind = \"round\"\n");
  const Image map = scene.materials.front().normal_map->image.decoded();
  EXPECT_EQ(map.width, 33);
  EXPECT_EQ(map.at(0, 0)[0], 4294967295.0F);
  EXPECT_EQ(map.at(0, 0)[1], 0.75F);
  EXPECT_EQ(map.at(0, 0)[2], 0.5F);
  ASSERT_TRUE(scene.materials.front().base_color_map);
  EXPECT_EQ(scene.materials.front().base_color_map->image.width(), 33);
}

TEST(SurfaceInScene, OwnColoursGiveWayToTheScenes) {
  const Scene scene = load_surface("[surface]\nname = \"lawn\"\n[brdf]\nbase_color = [1, 0, 0]\n");
  EXPECT_FALSE(scene.materials.front().base_color_map);
  EXPECT_EQ(scene.materials.front().base_color, glm::vec4(1, 0, 0, 1));
}

TEST(SurfaceInScene, MistakesAreNamedWithTheirLine) {
  const auto expect_error = [](const std::string& text, const std::vector<std::string>& wanted) {
    const std::string error = test::usage_error([&] { return load_surface(text); });
    for (const std::string& words : wanted) EXPECT_NE(error.find(words), std::string::npos) << words << "\n" << error;
  };
  const std::string hills = "[surface]\nname = \"hills\"\n";
  expect_error("[surface]\nname = \"hils\"\n", {"scene.toml:2", "did you mean `hills`"});
  expect_error("[surface]\n", {"scene.toml:1", "`name` in [surface] is missing"});
  expect_error(hills + "sead = 3\n", {"scene.toml:3", "did you mean `seed`"});
  expect_error(hills + "resolution = 0\n", {"scene.toml:3", "1 to 16384"});
  expect_error(hills + "resolution = 2.5\n", {"scene.toml:3", "whole number"});
  expect_error(hills + "seed = 4294967296\n", {"scene.toml:3", "`seed`"});
  expect_error(hills + "[surface.parameters]\nheigth = 1\n", {"scene.toml:4", "did you mean `height`"});
  expect_error(hills + "[surface.parameters]\nheight = 11\n", {"scene.toml:4", "0 to 10"});
  expect_error(hills + "[surface.parameters]\nkind = \"rund\"\n", {"scene.toml:4", "did you mean `round`"});
  expect_error(hills + "[surface.parameters]\ncount = 1.5\n", {"scene.toml:4", "whole number"});
  expect_error(hills + "[plane]\n", {"scene.toml:3", "`plane` excludes"});
}

}  // namespace
}  // namespace footprint
