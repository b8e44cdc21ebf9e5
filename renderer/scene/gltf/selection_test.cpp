// Files with several scenes, cameras and variants of materials, and extensions that only add a layer.
#include <gtest/gtest.h>

#include <algorithm>

#include "renderer/core/names.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "renderer/scene/model.hpp"
#include "tests/support/gltf_builder.hpp"
#include "tests/support/says.hpp"

namespace footprint {
namespace {

using nlohmann::json;
using test::GltfBuilder;
using test::make_quad;
using test::says;
using test::usage_error;

// Two scenes, `left` and one without a name: the quad at x = -5, and the quad at x = 7 before three cameras, of which
// two have names, one its node's. The second scene is the default one.
GltfBuilder two_scenes() {
  GltfBuilder file = make_quad();
  file.json["scenes"] = {{{"name", "left"}, {"nodes", {0}}}, {{"nodes", {1, 2, 3, 4}}}};
  file.json["scene"] = 1;
  file.json["cameras"] = {{{"type", "perspective"}, {"name", "wide"}, {"perspective", {{"yfov", 1.5}, {"znear", 0.1}}}},
                          {{"type", "perspective"}, {"perspective", {{"yfov", 0.25}, {"znear", 0.1}}}}};
  file.json["nodes"] = {{{"mesh", 0}, {"translation", {-5, 0, 0}}},
                        {{"mesh", 0}, {"translation", {7, 0, 0}}},
                        {{"camera", 0}},
                        {{"camera", 1}, {"name", "close"}, {"translation", {0, 0, 1}}},
                        {{"camera", 1}, {"translation", {0, 0, 2}}}};
  return file;
}

// The quad in red, in its variants `blue` and `green` with other materials; the third variant names nothing here.
GltfBuilder three_variants() {
  GltfBuilder file = make_quad();
  const auto material = [](const char* name, const json& color) {
    return json{{"name", name}, {"pbrMetallicRoughness", {{"baseColorFactor", color}}}};
  };
  file.json["materials"] = {material("red", {1, 0, 0, 1}), material("blue", {0, 0, 1, 1}),
                            material("green", {0, 1, 0, 1})};
  file.json["extensionsUsed"] = {"KHR_materials_variants"};
  file.json["extensionsRequired"] = {"KHR_materials_variants"};
  file.json["extensions"]["KHR_materials_variants"]["variants"] = {
      {{"name", "sea"}}, {{"name", "wood"}}, {{"name", "bare"}}};
  json& primitive = file.json["meshes"][0]["primitives"][0];
  primitive["material"] = 0;
  primitive["extensions"]["KHR_materials_variants"]["mappings"] = {{{"material", 1}, {"variants", {0}}},
                                                                   {{"material", 2}, {"variants", {1}}}};
  return file;
}

Model load(const GltfBuilder& file, const ModelSelection& selection = {}) { return load_gltf(file.write(), selection); }

float middle_of(const Model& model) {
  const auto& vertices = model.meshes.at(0).vertices;
  return 0.5F * (vertices[0].position.x + vertices[2].position.x);
}

TEST(FindEntry, TakesANameThenANumber) {
  const std::vector<std::string> names{"a", "1", "c"};
  EXPECT_EQ(find_entry("c", names), 2U);
  EXPECT_EQ(find_entry("1", names), 1U);
  EXPECT_EQ(find_entry("0", names), 0U);
  for (const char* wrong : {"3", "-1", "", "b", "1x", "99999999999999999999"}) {
    EXPECT_FALSE(find_entry(wrong, names)) << wrong;
  }
}

TEST(GltfSelection, ScenesAreTakenByNameNumberOrDefault) {
  EXPECT_EQ(middle_of(load(two_scenes())), 7.0F);
  EXPECT_EQ(middle_of(load(two_scenes(), {.scene = "left", .camera = {}, .variant = {}})), -5.0F);
  EXPECT_EQ(middle_of(load(two_scenes(), {.scene = "0", .camera = {}, .variant = {}})), -5.0F);
  const Model model = load(two_scenes());
  ASSERT_EQ(model.choices.size(), 2U);
  EXPECT_EQ(model.choices[0].names, (std::vector<std::string>{"left", "scene 1"}));
  EXPECT_EQ(model.choices[0].taken, 1U);
}

TEST(GltfSelection, CamerasAreThoseOfTheScene) {
  const Model first = load(two_scenes());
  EXPECT_FLOAT_EQ(first.camera->yfov, 1.5F);
  EXPECT_EQ(first.choices[1].names, (std::vector<std::string>{"wide", "close", "camera 2"}));
  EXPECT_TRUE(
      std::ranges::any_of(first.warnings, [](const auto& line) { return says(line, "the first of 3 cameras"); }));
  const Model close = load(two_scenes(), {.scene = {}, .camera = "close", .variant = {}});
  EXPECT_FLOAT_EQ(close.camera->yfov, 0.25F);
  EXPECT_EQ(close.camera->world[3].z, 1.0F);
  EXPECT_TRUE(close.warnings.empty());
  EXPECT_EQ(load(two_scenes(), {.scene = {}, .camera = "2", .variant = {}}).camera->world[3].z, 2.0F);
  EXPECT_FALSE(load(two_scenes(), {.scene = "left", .camera = {}, .variant = {}}).camera);
}

TEST(GltfSelection, VariantsChangeMaterials) {
  const auto color = [](const std::optional<std::string>& variant) {
    const Model model = load(three_variants(), {.scene = {}, .camera = {}, .variant = variant});
    EXPECT_TRUE(model.warnings.empty());
    return model.materials.at(0).name;
  };
  EXPECT_EQ(color({}), "red");
  EXPECT_EQ(color("sea"), "blue");
  EXPECT_EQ(color("1"), "green");
  EXPECT_EQ(color("bare"), "red");
}

TEST(GltfSelection, UnknownNamesAreErrorsWithTheNearest) {
  const std::string scene =
      usage_error([] { return load(two_scenes(), {.scene = "lefd", .camera = {}, .variant = {}}); });
  EXPECT_TRUE(says(scene, "made.gltf")) << scene;
  EXPECT_TRUE(says(scene, "scene")) << scene;
  EXPECT_TRUE(says(scene, "did you mean `left`")) << scene;
  const std::string camera =
      usage_error([] { return load(two_scenes(), {.scene = {}, .camera = "7", .variant = {}}); });
  EXPECT_TRUE(says(camera, "known: wide, close, camera 2")) << camera;
  const std::string variant =
      usage_error([] { return load(make_quad(), {.scene = {}, .camera = {}, .variant = "sea"}); });
  EXPECT_TRUE(says(variant, "it has no variant to choose")) << variant;
}

TEST(GltfSelection, MappingsMustNameWhatThereIs) {
  GltfBuilder file = three_variants();
  json& mapping = file.json["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"][0];
  mapping["variants"] = {3};
  EXPECT_TRUE(says(usage_error([&] { return load(file); }), "mappings[0].variants[0]: index 3 is out of range"));
  mapping["variants"] = {0};
  mapping["material"] = 3;
  EXPECT_TRUE(says(usage_error([&] { return load(file); }), "mappings[0].material: index 3 is out of range"));
}

TEST(GltfSelection, ALibrarySceneTakesThemToo) {
  const auto file = test::write_file("chosen.gltf", two_scenes().text());
  const auto toml = test::write_file("chosen.toml",
                                     "[model]\nfile = \"chosen.gltf\"\nscene = \"left\"\n"
                                     "[camera]\nposition = [0, 0, 9]\ntarget = [0, 0, 0]\n");
  EXPECT_EQ(load_scene(toml.string(), {}).bounds.centre().x, -5.0F);
  SceneOverrides overrides;
  overrides.model = {.scene = "1", .camera = "close", .variant = {}};
  const Scene other = load_scene(toml.string(), {}, overrides);
  EXPECT_EQ(other.bounds.centre().x, 7.0F);
  EXPECT_EQ(other.camera.world[3].z, 1.0F);
  const auto plane = test::write_file("plane.toml", "[plane]\n");
  EXPECT_TRUE(says(usage_error([&] { return load_scene(plane.string(), {}, overrides); }), "it has no model file"));
  const auto obj = test::write_file("one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_TRUE(says(usage_error([&] { return load_scene(obj.string(), {}, overrides); }), "an OBJ file has no scenes"));
}

TEST(GltfExtensions, LayersAreLeftOutWithAWarningEvenWhereRequired) {
  GltfBuilder file = make_quad();
  file.json["extensionsUsed"] = {"KHR_materials_sheen", "KHR_materials_iridescence", "EXT_other"};
  file.json["extensionsRequired"] = {"KHR_materials_sheen"};
  EXPECT_EQ(load(file).warnings, (std::vector<std::string>{
                                     "extension KHR_materials_sheen is left out: sheen",
                                     "extension KHR_materials_iridescence is left out: iridescence",
                                     "extension EXT_other is left out",
                                 }));
  file.json["extensionsRequired"] = {"EXT_other"};
  EXPECT_TRUE(says(usage_error([&] { return load(file); }), "requires what Footprint does not support: EXT_other"));
}

TEST(GltfExtensions, EncodingsAreNamedAsSuch) {
  GltfBuilder file = make_quad();
  file.json["extensionsRequired"] = {"KHR_texture_basisu"};
  EXPECT_TRUE(says(usage_error([&] { return load(file); }), "KHR_texture_basisu (KTX2 textures"));
}

TEST(GltfExtensions, KtxImagesAreNamedAsSuch) {
  GltfBuilder file = make_quad();
  const std::string head = "\xabKTX 20\xbb\r\n\x1a\n            ";
  const int view = file.add_view({reinterpret_cast<const std::uint8_t*>(head.data()), head.size()});
  file.json["images"] = {{{"bufferView", view}, {"mimeType", "image/ktx2"}}};
  file.json["materials"] = {{{"normalTexture", {{"index", 0}}}}};
  file.json["meshes"][0]["primitives"][0]["material"] = 0;
  file.json["textures"] = {{{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}}};
  EXPECT_EQ(load(file).warnings.at(0),
            "textures[0] is a KTX2 image (KHR_texture_basisu), which is not read: it is left out");
  file.json["textures"] = {{{"source", 0}}};
  EXPECT_TRUE(says(usage_error([&] { return load(file); }), "is a KTX2 image, which is not read"));
}

}  // namespace
}  // namespace footprint
