// [microgeometry] of a scene.toml: what a material gets, and every mistake named with its line.
#include "renderer/scene/microgeometry_content.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "renderer/core/error.hpp"
#include "renderer/scene/gltf_test_builder.hpp"
#include "renderer/scene/load_scene.hpp"

namespace footprint {
namespace {

Scene load(const std::string& microgeometry) {
  const std::string text = "[plane]\n[brdf]\nbase_color = [0.5, 0.5, 0.5]\n[microgeometry]\n" + microgeometry;
  return load_scene(test::write_file("microgeometry/scene.toml", text).string(), {});
}

TEST(MicrogeometryContent, GivesAMaterialItsPatchAndTheViewFromAbove) {
  const Scene scene = load(R"(kind = "weave"
resolution = 32
parameters = { warp_width = 0.5, weft_red = 0.0 }
)");
  const Material& material = scene.materials.at(0);
  ASSERT_NE(material.microgeometry, nullptr);
  EXPECT_EQ(material.microgeometry->patch.name, "weave");
  EXPECT_TRUE(has_colors(material.microgeometry->patch));
  EXPECT_EQ(material.normal_map->image->width, 32);
  EXPECT_FLOAT_EQ(material.base_color.g, 0.5F);
  EXPECT_FLOAT_EQ(material.base_color.r, 0.5F * material.microgeometry->mean_color.r);
}

TEST(MicrogeometryContent, TakesAModelsTriangles) {
  const auto model = std::filesystem::path("/usr/share/assimp/models/glTF2/BoxTextured-glTF/BoxTextured.gltf");
  if (!std::filesystem::exists(model)) GTEST_SKIP() << "the package assimp-testmodels is not there";
  const Scene scene = load("model = \"" + model.string() + "\"\nperiod = [2, 2]\n");
  EXPECT_EQ(scene.materials.at(0).microgeometry->patch.triangles.size(), 12U);
  EXPECT_EQ(scene.materials.at(0).microgeometry->patch.period, glm::vec2(2.0F));
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
  for (const auto& [text, wanted] : cases) {
    const std::string error = test::usage_error([&] { return load(text); });
    EXPECT_NE(error.find(wanted), std::string::npos) << text << "got: " << error;
  }
}

}  // namespace
}  // namespace footprint
