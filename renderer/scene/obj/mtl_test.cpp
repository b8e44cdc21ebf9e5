// MTL files: what becomes of each statement in a material, and what is left out with a warning.
#include "renderer/scene/obj/mtl.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "renderer/core/error.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/scene/model.hpp"
#include "tests/support/fresh_folder.hpp"

namespace footprint {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// A square of two materials, `a` and `b`, in a folder with an MTL file.
Model load_with(const std::filesystem::path& folder, const std::string& mtl) {
  std::ofstream(folder / "two words.mtl") << mtl;
  std::ofstream(folder / "m.obj")
      << "mtllib two words.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt "
         "1 1\nvt 0 1\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 3/3 4/4\n";
  return load_obj(folder / "m.obj");
}

Model load_with(const std::string& mtl) { return load_with(test::fresh_folder(), mtl); }

// A picture of two columns: rows are equal.
void write_columns(const std::filesystem::path& file, glm::vec3 left, glm::vec3 right) {
  Image image(2, 2, 3);
  for_each_texel(image, [&](int x, int y) {
    for (int c = 0; c < 3; ++c) image.at(x, y)[static_cast<std::size_t>(c)] = x == 0 ? left[c] : right[c];
  });
  write_png(file, image);
}

TEST(MtlFile, GivesEachMaterialItsValues) {
  const Model model =
      load_with("newmtl b\nKd 0.8 0.1 0.25\nKs 0.5\nNs 6\nnewmtl a\nKd 0.1 0.2 0.3\nPr 0.75\nPm 1\nKs 1 1 1\n");
  ASSERT_EQ(model.materials.size(), 2U);
  EXPECT_EQ(model.meshes.at(1).material, 1);
  const Material &a = model.materials[0], &b = model.materials[1];
  EXPECT_EQ(a.name, "a");
  EXPECT_EQ(a.base_color, glm::vec4(0.1F, 0.2F, 0.3F, 1.0F));
  EXPECT_EQ(a.roughness, 0.75F);
  EXPECT_EQ(a.metallic, 1.0F);
  EXPECT_EQ(a.dielectric_specular, glm::vec3(0.04F));  // Ks beside roughness and metalness
  EXPECT_EQ(b.base_color, glm::vec4(0.8F, 0.1F, 0.25F, 1.0F));
  EXPECT_EQ(b.dielectric_specular, glm::vec3(0.5F));
  EXPECT_NEAR(std::pow(b.roughness, 4.0F), 2.0F / (6.0F + 2.0F), 1e-6F);  // alpha^2
  EXPECT_EQ(b.metallic, 0.0F);
  EXPECT_THAT(model.warnings, ElementsAre());
}

TEST(MtlFile, DefaultsAreThoseOfAnObjFileAlone) {
  const Material a = load_with("newmtl other\nKd 1 0 0\n").materials.at(0);
  EXPECT_EQ(a.name, "a");
  EXPECT_EQ(a.base_color, glm::vec4(1.0F));
  EXPECT_EQ(a.roughness, 0.5F);
  EXPECT_EQ(a.metallic, 0.0F);
}

TEST(MtlFile, ReadsColourRoughnessAndMetalMaps) {
  const auto folder = test::fresh_folder();
  std::filesystem::create_directories(folder / "maps");
  write_columns(folder / "maps" / "colour.png", {1, 0, 0}, {0, 1, 0});
  write_columns(folder / "rough 1.png", glm::vec3(0.0F), glm::vec3(1.0F));
  const Model model = load_with(
      folder,
      "newmtl a\nKd 0.5 0.5 0.5\nmap_Kd -s 2 3 1 -o 0.25 0.5 -clamp on maps\\colour.png\nPr 0.5\nmap_Pr rough "
      "1.png\nnewmtl b\nNs 6\nmap_Pm \"rough 1.png\"\nmap_Ks maps/colour.png\n");
  EXPECT_THAT(model.warnings, ElementsAre());
  const Material &a = model.materials.at(0), &b = model.materials.at(1);
  EXPECT_EQ(a.base_color.r, 0.5F);
  EXPECT_EQ(a.base_color_map.value().image.decoded().at(1, 0)[1], 1.0F);
  EXPECT_EQ(a.base_color_map->coordinates.wrap[0], Wrap::clamp_to_edge);
  // OBJ's (u, v) = (0.5, 0.25) is (0.5, 0.75) here: 2 u + 0.25, and 1 - (3 v + 0.5).
  const glm::vec2 found = a.base_color_map->coordinates.transform * glm::vec3(0.5F, 0.75F, 1.0F);
  EXPECT_NEAR(found.x, 1.25F, 1e-6F);
  EXPECT_NEAR(found.y, -0.25F, 1e-6F);
  const Image rough = a.metallic_roughness_map.value().image.decoded();
  EXPECT_EQ(rough.at(1, 0)[0], 0.5F);
  EXPECT_EQ(rough.at(1, 0)[1], 0.0F);
  const Image metal = b.metallic_roughness_map.value().image.decoded();
  EXPECT_EQ(metal.at(0, 0)[0], b.roughness);
  EXPECT_EQ(metal.at(1, 1)[1], 1.0F);
  EXPECT_FALSE(b.specular_map);  // beside metalness
}

TEST(MtlFile, ReadsEmittedLight) {
  const auto folder = test::fresh_folder();
  write_columns(folder / "e.png", {1, 0, 0}, {0, 1, 0});
  const Model model = load_with(folder, "newmtl a\nKe 2 4 8\nmap_Ke e.png\nnewmtl b\nKe 0\nmap_Ke e.png\n");
  EXPECT_EQ(model.materials.at(0).emission, glm::vec3(2.0F, 4.0F, 8.0F));
  EXPECT_EQ(model.materials.at(0).emission_map.value().image.decoded().at(1, 0)[1], 1.0F);
  EXPECT_EQ(model.materials.at(1).emission, glm::vec3(0.0F));
  EXPECT_FALSE(model.materials.at(1).emission_map);
  EXPECT_EQ(load_with(folder, "newmtl a\nmap_Ke e.png\n").materials.at(0).emission, glm::vec3(1.0F));
  EXPECT_THAT(model.warnings, ElementsAre());
}

TEST(MtlFile, ReadsNormalAndBumpMaps) {
  const auto folder = test::fresh_folder();
  write_columns(folder / "n.png", {0.5F + 0.5F * 0.6F, 0.5F, 0.5F + 0.5F * 0.8F}, {0.5F, 0.5F, 1.0F});
  write_columns(folder / "h.png", glm::vec3(0.0F), glm::vec3(1.0F));
  const auto normal = [&](const std::string& statement) {
    const Model model = load_with(folder, "newmtl a\n" + statement + "\n");
    const Image map = model.materials.at(0).normal_map.value().image.decoded();
    const auto texel = map.at(0, 0);
    return glm::vec3(texel[0], texel[1], texel[2]);
  };
  const glm::vec3 tilted = normal("norm n.png");
  EXPECT_NEAR(tilted.x / tilted.z, 0.75F, 0.02F);
  EXPECT_EQ(normal("map_Kn n.png"), tilted);
  EXPECT_EQ(normal("map_Bump n.png"), tilted);  // coloured
  const glm::vec3 doubled = normal("bump -bm 2 n.png");
  EXPECT_NEAR(doubled.x / doubled.z, 1.5F, 0.04F);
  // Heights of 0 and 1 repeat, so that the two neighbours of each texel are equal; clamped, their difference is 1.
  EXPECT_EQ(normal("map_bump -bm 0.5 h.png"), glm::vec3(0.0F, 0.0F, 1.0F));
  const glm::vec3 slope = normal("bump -clamp on -bm 0.5 h.png");
  EXPECT_NEAR(slope.x / slope.z, -0.25F, 1e-5F);  // 0.5 texels over two texels
  EXPECT_THAT(load_with(folder, "newmtl a\nbump n.png\n").warnings,
              ElementsAre("the bump map n.png is coloured: it is taken for normals"));
  EXPECT_THAT(load_with(folder, "newmtl a\nnorm n.png\nbump h.png\n").warnings,
              ElementsAre("bump maps beside a normal map are left out"));
}

TEST(MtlFile, WarnsOfWhatItLeavesOut) {
  const auto warnings = [](const std::string& line) { return load_with("newmtl a\n" + line + "\n").warnings; };
  EXPECT_THAT(warnings("Ka 1 1 1\nKe 0 0 0\nd 1\nTr 0\nillum 2\nNi 1.5\nTf 1 1 1"), ElementsAre());
  EXPECT_THAT(warnings("d 0.5\nTr 0.5"), ElementsAre("transparent materials (d, Tr) are drawn opaque"));
  EXPECT_THAT(warnings("map_Ns a.png"), ElementsAre("the MTL statement map_Ns is not read: its maps are left out"));
  EXPECT_THAT(warnings("map_Kd a.png"),
              ElementsAre("two words.mtl:2: there is no picture `a.png`: the map is left out"));
  EXPECT_THAT(warnings("map_Kd -mm 0 1 -blendu on C:\\x\\a b.png").at(1), HasSubstr("no picture `C:\\x\\a b.png`"));
  EXPECT_THAT(warnings("Kd 1.5 1 1"), ElementsAre("two words.mtl: kd of 1.5 is taken as 1"));
  EXPECT_THAT(warnings("Kd spectral a.rfl"), ElementsAre("kd as a spectrum or as XYZ is left out"));
}

TEST(MtlFile, NamesTheLineOfAFault) {
  const auto message = [](const std::string& mtl) -> std::string {
    try {
      (void)load_with(mtl);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(message("\nKd 1 1 1\n"), HasSubstr("two words.mtl:2: a value before the first `newmtl`"));
  EXPECT_THAT(message("newmtl a\nKd 1 x 1\n"), HasSubstr("two words.mtl:2: `x` is not a number"));
  EXPECT_THAT(message("newmtl a\nNs nan\n"), HasSubstr("two words.mtl:2: `nan` is not a number"));
  EXPECT_THAT(message("newmtl a\nmap_Kd -bm 1\n"), HasSubstr("two words.mtl:2: map_Kd names no picture"));
  const auto folder = test::fresh_folder();
  std::ofstream(folder / "broken.png") << "no picture";
  EXPECT_THROW((void)load_with(folder, "newmtl a\nmap_Kd broken.png\n"), Error);
}

}  // namespace
}  // namespace footprint
