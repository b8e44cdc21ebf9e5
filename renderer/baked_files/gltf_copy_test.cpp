// Copies of glTF files: the replaced maps are there, all else is as it was, and what makes no sense is refused.
#include "renderer/baked_files/gltf_copy.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "renderer/image/image_io.hpp"
#include "renderer/scene/model.hpp"
#include "tests/support/fresh_folder.hpp"
#include "tests/support/gltf_builder.hpp"
#include "tests/support/says.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

namespace fs = std::filesystem;
using test::GltfBuilder;

Image encoded(const Image& normals) {
  Image out(normals.width, normals.height, 3);
  for (std::size_t i = 0; i < out.texel_count(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) out.texels[3 * i + c] = 0.5F * normals.texels[4 * i + c] + 0.5F;
  }
  return out;
}

// A quad whose normal map is scaled, turned and clamped, with another texture for the colour.
GltfBuilder bumpy() {
  GltfBuilder quad = test::make_quad();
  const int normal = quad.add_texture(encoded(random_normals(8, 8, 0.5F, 1)));
  const int color = quad.add_texture(Image(2, 2, 3, 0.5F));
  quad.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}}};
  quad.json["textures"][static_cast<std::size_t>(normal)]["sampler"] = 0;
  quad.json["extensionsUsed"] = {"KHR_texture_transform"};
  quad.json["materials"] = {
      {{"name", "bumpy"},
       {"normalTexture",
        {{"index", normal}, {"scale", 0.5}, {"extensions", {{"KHR_texture_transform", {{"scale", {2.0, 3.0}}}}}}}},
       {"pbrMetallicRoughness",
        {{"baseColorTexture", {{"index", color}}}, {"roughnessFactor", 0.25}, {"metallicFactor", 0.75}}}}};
  quad.json["meshes"][0]["primitives"][0]["material"] = 0;
  return quad;
}

ReplacedMaps smaller_maps(bool metallic_in_map) {
  Image rough(4, 4, 3, 1.0F);
  for (std::size_t i = 0; i < rough.texel_count(); ++i) {
    rough.texels[3 * i + 1] = static_cast<float>(10 + i) / 255.0F;
    if (metallic_in_map) rough.texels[3 * i + 2] = static_cast<float>(100 + i) / 255.0F;
  }
  return {.material = "bumpy",
          .normal = encoded(random_normals(4, 4, 0.3F, 2)),
          .rough_metallic = rough,
          .metallic_in_map = metallic_in_map,
          .roughness_mips = {"../a.mip0.png", "../a.mip1.png"}};
}

Material copied_material(const fs::path& source, const ReplacedMaps& maps, const fs::path& folder) {
  const std::string name = write_gltf_copy(source, std::span(&maps, 1), folder);
  fs::remove(source);  // the copy does not need it
  return load_gltf(folder / name).materials.at(0);
}

void expect_copied(const Material& before, const Material& after) {
  EXPECT_EQ(after.name, "bumpy");
  ASSERT_TRUE(after.normal_map && after.metallic_roughness_map && after.base_color_map);
  EXPECT_EQ(after.normal_map->coordinates, before.normal_map->coordinates);
  EXPECT_EQ(after.metallic_roughness_map->coordinates, before.normal_map->coordinates);
  EXPECT_EQ(after.base_color_map->image.decoded(), before.base_color_map->image.decoded());
  const Image expected = random_normals(4, 4, 0.3F, 2);
  const Image normals = after.normal_map->image.decoded();
  ASSERT_EQ(normals.width, 4);
  for (std::size_t i = 0; i < normals.texels.size(); ++i) EXPECT_NEAR(normals.texels[i], expected.texels[i], 0.01);
  const Image rough = after.metallic_roughness_map->image.decoded();
  for (std::size_t i = 0; i < rough.texel_count(); ++i)
    EXPECT_NEAR(rough.texels[2 * i], static_cast<float>(10 + i) / 255.0F, 1e-6);
}

TEST(GltfCopy, HasTheMapsAndKeepsTheRest) {
  const fs::path source = bumpy().write();
  const Material before = load_gltf(source).materials.at(0);
  const Material after = copied_material(source, smaller_maps(false), test::fresh_folder());
  expect_copied(before, after);
  EXPECT_FLOAT_EQ(after.metallic_roughness_map->image.decoded().texels[1], 0.75F);  // the factor stays
}

TEST(GltfCopy, OfAContainerIsTheSame) {
  const fs::path source = test::write_file("bumpy.glb", bumpy().glb());
  const Material before = load_gltf(source).materials.at(0);
  const Material after = copied_material(source, smaller_maps(true), test::fresh_folder());
  expect_copied(before, after);
  EXPECT_NEAR(after.metallic_roughness_map->image.decoded().texels[1], 100.0 / 255.0, 1e-6);
}

// Files of the source lie elsewhere, under names that a copy could not have.
TEST(GltfCopy, TakesItsFilesAlong) {
  GltfBuilder quad = bumpy();
  fs::create_directories(test::process_folder() / "a b");
  write_png(test::process_folder() / "a b" / "color.png", Image(2, 2, 3, 0.25F));
  quad.json["images"].push_back({{"uri", "a%20b/color.png"}});
  quad.json["textures"][1]["source"] = quad.json["images"].size() - 1;
  const fs::path source = quad.write();
  const fs::path folder = test::fresh_folder();
  const ReplacedMaps maps = smaller_maps(false);
  const std::string name = write_gltf_copy(source, std::span(&maps, 1), folder);
  fs::remove_all(test::process_folder() / "a b");
  const auto color = load_gltf(folder / name).materials.at(0).base_color_map;
  ASSERT_TRUE(color.has_value());
  EXPECT_NEAR(color->image.decoded().texels[0], 0.0513, 1e-3);  // sRGB 0.25, 64 of 255
}

TEST(GltfCopy, NamesTheWholeChainInExtras) {
  const fs::path folder = test::fresh_folder();
  const ReplacedMaps maps = smaller_maps(false);
  const std::string name = write_gltf_copy(bumpy().write(), std::span(&maps, 1), folder);
  std::ifstream stream(folder / name);
  const auto json = nlohmann::json::parse(std::string(std::istreambuf_iterator<char>(stream), {}));
  const std::size_t texture = json["materials"][0]["pbrMetallicRoughness"]["metallicRoughnessTexture"]["index"];
  EXPECT_EQ(json["textures"][texture]["extras"]["footprint_mips"], nlohmann::json(maps.roughness_mips));
}

TEST(GltfCopy, RefusesMaterialsThatStoreGlossiness) {
  GltfBuilder glossy = bumpy();
  glossy.json["materials"][0]["extensions"]["KHR_materials_pbrSpecularGlossiness"] = nlohmann::json::object();
  const fs::path source = glossy.write();
  const ReplacedMaps maps = smaller_maps(false);
  EXPECT_TRUE(
      test::says(test::usage_error([&] { return write_gltf_copy(source, std::span(&maps, 1), test::fresh_folder()); }),
                 "material `bumpy` stores its roughness as glossiness"));
}

TEST(GltfCopy, RefusesNamesThatAreNotOneMaterials) {
  GltfBuilder twice = bumpy();
  twice.json["materials"].push_back(twice.json["materials"][0]);
  const fs::path source = twice.write();
  const ReplacedMaps maps = smaller_maps(false);
  EXPECT_TRUE(
      test::says(test::usage_error([&] { return write_gltf_copy(source, std::span(&maps, 1), test::fresh_folder()); }),
                 "two materials are called `bumpy`"));
  ReplacedMaps other = maps;
  other.material = "smooth";
  EXPECT_TRUE(
      test::says(test::usage_error([&] { return write_gltf_copy(source, std::span(&other, 1), test::fresh_folder()); }),
                 "no material is called `smooth`"));
}

}  // namespace
}  // namespace footprint::testing
