// Thousands of damaged glTF files: each loads or throws Error; nothing else may happen. The sanitizer preset looks on.
#include <gtest/gtest.h>

#include <string>

#include "renderer/scene/model.hpp"
#include "tests/support/gltf_builder.hpp"
#include "tests/support/sound_model.hpp"

namespace footprint {
namespace {

using test::GltfBuilder;

/// A file that uses about everything that the loader reads.
GltfBuilder make_rich() {
  GltfBuilder quad = test::make_quad();
  const int texture = quad.add_texture(Image(2, 2, 3, 0.75F));
  const nlohmann::json info = {{"index", texture},
                               {"extensions", {{"KHR_texture_transform", {{"scale", {2, 2}}, {"rotation", 1.5}}}}}};
  quad.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 10497}}};
  quad.json["textures"][0]["sampler"] = 0;
  quad.json["materials"] = {{{"name", "m"},
                             {"alphaMode", "MASK"},
                             {"normalTexture", info},
                             {"pbrMetallicRoughness", {{"baseColorTexture", info}}}}};
  quad.json["meshes"][0]["primitives"][0]["material"] = 0;
  quad.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}}};
  quad.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}, {"spot", {{"outerConeAngle", 0.5}}}}};
  quad.json["nodes"] = {
      {{"mesh", 0}, {"children", {1}}, {"rotation", {0, 0, 0, 1}}},
      {{"camera", 0}, {"translation", {0, 0, 5}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}};
  const int indices = quad.add_view(std::vector<std::uint8_t>{1, 3});
  const int values = quad.add_view(std::vector<std::uint8_t>(24, 0));
  quad.json["accessors"][0]["sparse"] = {{"count", 2},
                                         {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                         {"values", {{"bufferView", values}}}};
  return quad;
}

/// Returns how many of `count` damaged files still load.
int fuzz(const std::string& whole, const std::string& name, int count, unsigned seed) {
  return test::count_loaded(whole, count, seed,
                            [&](const std::string& text) { return load_gltf(test::write_file(name, text)); });
}

TEST(GltfFuzz, DamagedTextLoadsOrThrowsError) {
  // Without the data URI's bulk, so that most changes hit the structure.
  const GltfBuilder rich = make_rich();
  nlohmann::json document = rich.json;
  test::write_file("fuzz.bin", std::string(rich.data.begin(), rich.data.end()));
  document["buffers"] = {{{"byteLength", rich.data.size()}, {"uri", "fuzz.bin"}}};
  const int loaded = fuzz(document.dump(), "fuzz.gltf", 1800, 1);
  EXPECT_GT(loaded, 10);    // the files are not all refused at the door
  EXPECT_LT(loaded, 1790);  // and not all harmless
}

TEST(GltfFuzz, DamagedBinaryLoadsOrThrowsError) { EXPECT_GT(fuzz(make_rich().glb(), "fuzz.glb", 1200, 2), 10); }

TEST(GltfFuzz, TheUndamagedFileLoads) {
  const Model model = load_gltf(test::write_file("rich.glb", make_rich().glb()));
  test::expect_sound(model);
  EXPECT_TRUE(model.camera);
  EXPECT_EQ(model.lights.size(), 1U);
  EXPECT_TRUE(model.materials.at(0).normal_map);
}

}  // namespace
}  // namespace footprint
