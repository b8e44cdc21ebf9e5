// [microgeometry] of a scene.toml: what a material gets, and every mistake named with its line.
#include "renderer/scene/assembly/microgeometry_content.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "renderer/core/error.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "tests/support/gltf_builder.hpp"

namespace footprint {
namespace {

Scene load_microgeometry(const std::string& microgeometry) {
  const std::string text = "[plane]\n[brdf]\nbase_color = [0.5, 0.5, 0.5]\n[microgeometry]\n" + microgeometry;
  return load_scene(test::write_file("microgeometry/scene.toml", text).string(), {});
}

TEST(MicrogeometryContent, GivesAMaterialItsPatchAndTheViewFromAbove) {
  const Scene scene = load_microgeometry(R"(kind = "weave"
resolution = 32
parameters = { warp_width = 0.5, weft_red = 0.0 }
)");
  const Material& material = scene.materials.at(0);
  ASSERT_NE(material.microgeometry, nullptr);
  EXPECT_EQ(material.microgeometry->patch.name, "weave");
  EXPECT_TRUE(has_colors(material.microgeometry->patch));
  EXPECT_EQ(material.normal_map->image.width(), 32);
  EXPECT_FLOAT_EQ(material.base_color.g, 0.5F);
  EXPECT_FLOAT_EQ(material.base_color.r, 0.5F * material.microgeometry->mean_color.r);
}

TEST(MicrogeometryContent, TakesAModelsTriangles) {
  const auto model = std::filesystem::path("/usr/share/assimp/models/glTF2/BoxTextured-glTF/BoxTextured.gltf");
  if (!std::filesystem::exists(model)) GTEST_SKIP() << "the package assimp-testmodels is not there";
  const Scene scene = load_microgeometry("model = \"" + model.string() + "\"\nperiod = [2, 2]\n");
  const Patch& patch = scene.materials.at(0).microgeometry->patch;
  EXPECT_EQ(patch.triangles.size(), 12U);
  EXPECT_EQ(patch.period, glm::vec2(2.0F));
  // The cube about the origin, a whole period further and on the ground.
  glm::vec3 lower(1e9F);
  for (const glm::vec3& vertex : patch.vertices) lower = glm::min(lower, vertex);
  EXPECT_EQ(lower, glm::vec3(1.5F, 1.5F, 0.0F));
}

TEST(MicrogeometryContent, MistakesNameTheirLine) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"seed = 1\n", "or `model` must be given"},
      {"kind = \"weave\"\nmodel = \"a.gltf\"\n", "only one of them"},
      {"kind = \"weaves\"\n", "weave"},
      {"kind = \"weave\"\nparameters = { warp_width = 3 }\n", ":6"},
      {"kind = \"weave\"\nparameters = { warp_widht = 0.3 }\n", "warp_width"},
      {"kind = \"flat\"\nperiod = [1, 1]\n", "belongs to a model"},
      {"model = \"nowhere.gltf\"\n", "nowhere.gltf"},
      {"kind = \"flat\"\nresolution = 0\n", "resolution"}};
  for (const auto& mistake : cases) {
    const std::string error = test::usage_error([&] { return load_microgeometry(mistake.first); });
    EXPECT_NE(error.find(mistake.second), std::string::npos) << mistake.first << "got: " << error;
  }
}

// A plane with two weaves and a map of indices beside the scene.
Scene load_two(const std::string& maps, const Image& indices) {
  const std::string text =
      "[plane]\n" + maps + "[[microgeometry]]\nkind = \"flat\"\n[[microgeometry]]\nkind = \"weave\"\n";
  const auto file = test::write_file("indices/scene.toml", text);
  write_exr(file.parent_path() / "indices.exr", indices);
  Image bytes = indices;
  for (float& value : bytes.texels) value /= 255.0F;
  write_png(file.parent_path() / "indices.png", bytes);
  return load_scene(file.string(), {});
}

TEST(MicrogeometryContent, AMapOfIndicesChoosesAmongSeveral) {
  Image indices(2, 2, 1);
  indices.texels = {0.0F, 1.0F, 1.0F, 1.0F};
  for (const char* file : {"indices.exr", "indices.png"}) {
    const Scene scene = load_two(std::string("[maps]\nmaterial = { file = \"") + file + "\", uv = [3, 2] }\n", indices);
    ASSERT_EQ(scene.materials.size(), 2U);
    EXPECT_EQ(scene.materials[0].microgeometry->patch.name, "flat");
    EXPECT_EQ(scene.materials[1].microgeometry->patch.name, "weave");
    EXPECT_TRUE(scene.materials[0].share->first);
    EXPECT_FALSE(scene.materials[1].share->first);
    EXPECT_EQ(scene.materials[0].share->map.image.decoded().texels, (std::vector{1.0F, 0.0F, 0.0F, 0.0F}));
    EXPECT_EQ(scene.materials[1].share->map.image.decoded().texels, (std::vector{0.0F, 1.0F, 1.0F, 1.0F}));
    EXPECT_EQ(scene.materials[1].share->map.coordinates.transform[0].x, 3.0F);
    ASSERT_EQ(scene.meshes.size(), 2U);
    EXPECT_EQ(scene.meshes[1].material, 1);
    EXPECT_EQ(scene.meshes[0].indices, scene.meshes[1].indices);
  }
}

TEST(MicrogeometryContent, MistakesAroundAMapOfIndicesAreNamed) {
  const auto error_of = [](const std::string& maps, float index) {
    return test::usage_error([&] { return load_two(maps, Image(2, 1, 1, index)); });
  };
  const std::string map = "[maps]\nmaterial = { file = \"indices.png\" }\n";
  EXPECT_NE(error_of("", 0.0F).find("without a map"), std::string::npos);
  EXPECT_NE(error_of(map, 2.0F).find("indices.png"), std::string::npos);
  EXPECT_NE(error_of(map, 2.0F).find("is not an index of the 2"), std::string::npos);
  EXPECT_NE(error_of("[maps]\nmaterial = { file = \"none.png\" }\n", 0.0F).find("none.png"), std::string::npos);
  const std::string one = test::usage_error(
      [] { return load_microgeometry("kind = \"flat\"\n[maps]\nmaterial = { file = \"a.png\" }\n"); });
  EXPECT_NE(one.find("several [[microgeometry]]"), std::string::npos) << one;
}

}  // namespace
}  // namespace footprint
