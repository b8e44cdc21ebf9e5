// Copies of glTF files: the replaced maps are there, all else is as it was, and what makes no sense is refused.
#include "renderer/baked_files/baked_files.hpp"

#include <gtest/gtest.h>

#include <OpenImageIO/imageio.h>

#include <fstream>
#include <iterator>

#include "renderer/image/image_io.hpp"
#include "renderer/scene/model.hpp"
#include "tests/support/fresh_folder.hpp"
#include "tests/support/gltf_builder.hpp"
#include "tests/support/ktx2_reader.hpp"
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
  // Coarser levels that are no means of finer ones: only files with a whole chain can have them.
  return {.material = "bumpy",
          .normal = {encoded(random_normals(4, 4, 0.3F, 2)), Image(2, 2, 3, 0.2F), Image(1, 1, 3, 0.4F)},
          .rough_metallic = {rough, Image(2, 2, 3, 0.6F), Image(1, 1, 3, 0.8F)},
          .anisotropy = {Image(2, 2, 3, 0.3F), Image(1, 1, 3, 0.7F)},
          .metallic_in_map = metallic_in_map};
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

std::vector<std::uint8_t> file_bytes(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// The first three channels of a level of DDS, as OpenImageIO reads it.
std::vector<float> dds_level(const fs::path& file, int level) {
  const auto input = OIIO::ImageInput::open(file.string());
  if (!input) throw std::runtime_error(OIIO::geterror());
  const OIIO::ImageSpec spec = input->spec(0, level);
  std::vector<float> texels(static_cast<std::size_t>(3 * spec.width * spec.height));
  if (!input->read_image(0, level, 0, 3, OIIO::TypeDesc::FLOAT, texels.data()))
    throw std::runtime_error(input->geterror());
  return texels;
}

void expect_chain(const fs::path& folder, const nlohmann::json& json, std::size_t texture,
                  const std::vector<Image>& chain) {
  const auto& entry = json["textures"][texture];
  const std::size_t dds = entry["extensions"]["MSFT_texture_dds"]["source"];
  const test::Ktx2File ktx2 =
      test::read_ktx2(file_bytes(folder / entry["extras"]["footprint_ktx2"].get<std::string>()));
  EXPECT_EQ(ktx2.vk_format, 37U);  // VK_FORMAT_R8G8B8A8_UNORM
  ASSERT_EQ(ktx2.levels.size(), chain.size());
  for (std::size_t level = 0; level < chain.size(); ++level) {
    const std::vector<float> by_oiio =
        dds_level(folder / json["images"][dds]["uri"].get<std::string>(), static_cast<int>(level));
    ASSERT_EQ(by_oiio.size(), chain[level].texels.size());
    for (std::size_t i = 0; i < by_oiio.size(); ++i) {
      EXPECT_NEAR(by_oiio[i], chain[level].texels[i], 0.51 / 255);
      EXPECT_NEAR(ktx2.levels[level].bytes[i / 3 * 4 + i % 3] / 255.0, chain[level].texels[i], 0.51 / 255);
    }
  }
}

TEST(GltfCopy, RefersToTheWholeChains) {
  const fs::path folder = test::fresh_folder();
  const ReplacedMaps maps = smaller_maps(true);
  const std::string name = write_gltf_copy(bumpy().write(), std::span(&maps, 1), folder);
  std::ifstream stream(folder / name);
  const auto json = nlohmann::json::parse(std::string(std::istreambuf_iterator<char>(stream), {}));
  EXPECT_EQ(json["extensionsUsed"],
            nlohmann::json({"KHR_texture_transform", "MSFT_texture_dds", "KHR_materials_anisotropy"}));
  EXPECT_FALSE(json.contains("extensionsRequired"));  // a reader without it takes the PNG
  const auto& material = json["materials"][0];
  expect_chain(folder, json, material["normalTexture"]["index"], maps.normal);
  expect_chain(folder, json, material["pbrMetallicRoughness"]["metallicRoughnessTexture"]["index"],
               maps.rough_metallic);
  const auto& anisotropy = material["extensions"]["KHR_materials_anisotropy"];
  EXPECT_EQ(anisotropy["anisotropyStrength"], 1.0);
  expect_chain(folder, json, anisotropy["anisotropyTexture"]["index"], maps.anisotropy);
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

TEST(GltfCopy, TellsMaterialsOfOneNameApart) {
  GltfBuilder twice = bumpy();
  twice.json["materials"].push_back(twice.json["materials"][0]);
  const fs::path source = twice.write(), folder = test::fresh_folder();
  ReplacedMaps maps = smaller_maps(false);
  maps.material = "bumpy [1]";
  const nlohmann::json json =
      nlohmann::json::parse(std::ifstream(folder / write_gltf_copy(source, std::span(&maps, 1), folder)));
  EXPECT_EQ(json["materials"][0], twice.json["materials"][0]);
  EXPECT_NE(json["materials"][1], twice.json["materials"][1]);
}

TEST(GltfCopy, RefusesNamesThatAreNoMaterials) {
  const fs::path source = bumpy().write();
  ReplacedMaps other = smaller_maps(false);
  other.material = "smooth";
  EXPECT_TRUE(
      test::says(test::usage_error([&] { return write_gltf_copy(source, std::span(&other, 1), test::fresh_folder()); }),
                 "no material is called `smooth`"));
}

}  // namespace
}  // namespace footprint::testing
