// Scenes of several parts: what a [[part]] may say, what it shares with the others, where it comes to stand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/scene/assembly/load_scene.hpp"
#include "renderer/scene/geometry.hpp"
#include "tests/support/gltf_builder.hpp"

namespace footprint {
namespace {

Mesh tile(const SurfaceSettings& /*settings*/) { return make_plane({2.0F, 2.0F}, {1.0F, 1.0F}); }
Image upright(const SurfaceSettings& settings) {
  Image map(settings.resolution, settings.resolution, 4, 0.0F);
  for (std::size_t i = 0; i < map.texel_count(); ++i) map.texels[4 * i + 2] = map.texels[4 * i + 3] = 1.0F;
  return map;
}
Image exponents(const SurfaceSettings& /*settings*/) { return {2, 3, 1, 50.0F}; }

const std::vector<Surface>& tiles() {
  static const std::vector<Surface> surfaces{{.name = "tiles",
                                              .summary = {},
                                              .parameters = {},
                                              .default_resolution = 4,
                                              .normals = upright,
                                              .lobe_parameter = exponents,
                                              .distribution = NormalDistribution::blinn_phong,
                                              .mesh = tile}};
  return surfaces;
}

Scene load_parts(const std::string& settings) {
  return load_scene(test::write_file("parts/scene.toml", settings).string(), {.folder = {}, .surfaces = tiles()});
}

TEST(Parts, SurfacesThatAreMadeHaveNoMoreTexelsThanRequested) {
  const auto file = test::write_file("parts/scene.toml",
                                     "[[part]]\nsurface = { name = \"tiles\" }\n"
                                     "[[part]]\nsurface = { name = \"tiles\", resolution = 2 }\n");
  const SceneLibrary tiled{.folder = {}, .surfaces = tiles()};
  const auto sides = [&](std::optional<int> most_texels) {
    SceneOverrides overrides;
    overrides.most_texels = most_texels;
    const Scene scene = load_scene(file.string(), tiled, overrides);
    return std::pair(scene.materials.at(0).normal_map->image.width(), scene.materials.at(1).normal_map->image.width());
  };
  EXPECT_EQ(sides({}), std::pair(4, 2));
  EXPECT_EQ(sides(3), std::pair(3, 2));
}

void expect_part_error(const std::string& text, const std::vector<std::string>& wanted) {
  const std::string error = test::usage_error([&] { return load_parts(text); });
  for (const std::string& words : wanted) EXPECT_THAT(error, ::testing::HasSubstr(words));
}

TEST(Parts, EachHasItsContentMaterialAndPlace) {
  const Scene scene = load_parts(R"([brdf]
distribution = "blinn_phong"
fresnel = "none"
[[part]]
name = "floor"
plane = { size = [4, 4] }
brdf = { exponent = 7, specular = [0.1, 0.2, 0.3] }
[[part]]
surface = { name = "tiles" }
tiling = { uv = [2, 3] }
[part.place]
translate = [10, 0, 0]
rotate_degrees = [0, 90, 0]
scale = 3
)");
  ASSERT_EQ(scene.meshes.size(), 2U);
  ASSERT_EQ(scene.materials.size(), 2U);
  EXPECT_EQ(scene.meshes[0].name, "floor/plane");
  EXPECT_EQ(scene.materials[0].name, "floor/plane");
  EXPECT_EQ(scene.materials[1].name, "tiles");
  EXPECT_EQ(scene.meshes[1].material, 1);
  EXPECT_EQ(scene.materials[0].lobe_parameter, 7.0F);
  EXPECT_EQ(scene.materials[0].dielectric_specular, glm::vec3(0.1F, 0.2F, 0.3F));
  EXPECT_EQ(scene.materials[0].brdf, scene.materials[1].brdf);
  EXPECT_EQ(scene.materials[1].brdf.fresnel, FresnelTerm::none);
  EXPECT_EQ(scene.materials[1].normal_map->coordinates.transform[0], glm::vec2(2, 0));
  // Facing +z and 2 m wide; turned about y it faces +x, three times as large, 10 m to the right.
  const Vertex& corner = scene.meshes[1].vertices.front();
  EXPECT_NEAR(glm::length(corner.position - glm::vec3(10, 3, 3)), 0.0F, 1e-5F);
  EXPECT_NEAR(glm::length(corner.normal - glm::vec3(1, 0, 0)), 0.0F, 1e-6F);
  EXPECT_NEAR(glm::length(glm::vec3(corner.tangent) - glm::vec3(0, 0, -1)), 0.0F, 1e-6F);
  EXPECT_NEAR(scene.bounds.upper.x, 10.0F, 1e-5F);
}

TEST(Parts, HaveCoatsOfTheirOwn) {
  const Scene scene = load_parts(R"([[part]]
plane = {}
clear_coat = { weight = 0.5, roughness = 0.25 }
[[part]]
plane = {}
clear_coat = {}
[[part]]
plane = {}
clear_coat = { weight = 0 }
[[part]]
plane = {}
)");
  ASSERT_EQ(scene.materials.size(), 4U);
  EXPECT_EQ(scene.materials[0].name, "plane [0]");
  EXPECT_EQ(scene.materials[3].name, "plane [3]");
  ASSERT_TRUE(scene.materials[0].coat && scene.materials[1].coat);
  EXPECT_EQ(scene.materials[0].coat->weight, 0.5F);
  EXPECT_EQ(scene.materials[0].coat->roughness, 0.25F);
  EXPECT_EQ(scene.materials[1].coat->weight, 1.0F);
  EXPECT_EQ(scene.materials[1].coat->roughness, 0.0F);
  EXPECT_FALSE(scene.materials[2].coat);
  EXPECT_FALSE(scene.materials[3].coat);
  expect_part_error("[[part]]\nplane = {}\nclear_coat = { weight = 2 }\n", {"weight", "0", "1"});
  expect_part_error("[[part]]\nplane = {}\nclear_coat = { wieght = 1 }\n", {"wieght", "weight"});
  expect_part_error("[[part]]\nplane = {}\nclear_coat = { normal_map = 'missing.png' }\n", {"missing.png"});
  expect_part_error("[clear_coat]\n[[part]]\nplane = {}\n", {"clear_coat", "excludes [[part]]"});
}

TEST(Parts, TurnAboutXThenYThenZ) {
  const Scene scene = load_parts("[[part]]\nplane = {}\nplace = { rotate_degrees = [90, 0, 90] }\n");
  // About x the normal +z goes to -y, about z on to +x.
  EXPECT_NEAR(glm::length(scene.meshes[0].vertices[0].normal - glm::vec3(1, 0, 0)), 0.0F, 1e-6F);
}

TEST(Parts, MoveTheirModelsLightsAndCamera) {
  const auto file = test::write_file("parts/lit.gltf", R"({"asset":{"version":"2.0"},
    "extensionsUsed":["KHR_lights_punctual"],
    "extensions":{"KHR_lights_punctual":{"lights":[{"type":"spot","intensity":5,"spot":{}}]}},
    "cameras":[{"type":"perspective","perspective":{"yfov":0.5,"znear":0.1}}],
    "nodes":[{"extensions":{"KHR_lights_punctual":{"light":0}},"translation":[1,0,0]},
             {"camera":0,"translation":[0,0,4]}],
    "scenes":[{"nodes":[0,1]}],"scene":0})");
  const Scene scene = load_parts("[[part]]\nmodel = { file = \"" + file.filename().string() +
                                 "\" }\nplace = { translate = [0, 1, 0], rotate_degrees = [0, 90, 0] }\n"
                                 "[[part]]\nplane = {}\n");
  ASSERT_EQ(scene.lights.size(), 1U);
  const auto& spot = std::get<SpotLight>(scene.lights[0]);
  EXPECT_NEAR(glm::length(spot.point.position - glm::vec3(0, 1, -1)), 0.0F, 1e-6F);
  EXPECT_NEAR(glm::length(spot.direction - glm::vec3(-1, 0, 0)), 0.0F, 1e-6F);
  EXPECT_EQ(spot.point.intensity, glm::vec3(5.0F));
  EXPECT_NEAR(glm::length(glm::vec3(scene.camera.world[3]) - glm::vec3(4, 1, 0)), 0.0F, 1e-6F);
}

TEST(Parts, AModelMayBeUnwrappedAndDressedInASurface) {
  test::write_file("parts/two.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 -1\nf 1 2 3\nf 2 4 3\n");
  const Scene scene = load_parts(
      "[model]\nfile = \"two.obj\"\nunwrap = true\n[surface]\nname = \"tiles\"\n[brdf]\nspecular = [1, 1, 1]\n");
  ASSERT_EQ(scene.materials.size(), 1U);
  EXPECT_EQ(scene.materials[0].name, "tiles");
  EXPECT_TRUE(scene.materials[0].lobe_parameter_map && scene.materials[0].normal_map);
  EXPECT_EQ(scene.materials[0].brdf.distribution, NormalDistribution::blinn_phong);
  for (const Vertex& vertex : scene.meshes.at(0).vertices) {
    EXPECT_GT(vertex.uv0.x, 0.0F);
    EXPECT_LT(vertex.uv0.y, 1.0F);
  }
}

TEST(Parts, MistakesAreNamedWithTheirLine) {
  const std::string part = "[[part]]\nplane = {}\n";
  expect_part_error(part + "[model]\nfile = \"a.gltf\"\n", {"scene.toml:3", "`model` excludes [[part]]"});
  expect_part_error("[brdf]\nexponent = 3\n" + part, {"scene.toml:2", "unknown key `exponent` in [brdf]"});
  expect_part_error(part + "brdf = { fresnel = \"none\" }\n", {"scene.toml:3", "unknown key `fresnel`"});
  expect_part_error(part + "brdf = { exponent = 3 }\n", {"scene.toml:3", "does not belong to the distribution"});
  expect_part_error(part + "place = { scale = 0 }\n", {"scene.toml:3", "`scale`", "1e-06"});
  expect_part_error(part + "place = { turn = 3 }\n", {"scene.toml:3", "unknown key `turn`"});
  expect_part_error(part + "surface = { name = \"tiles\" }\n", {"scene.toml:2", "excludes `model` and `surface`"});
  expect_part_error("[[part]]\nname = \"empty\"\n", {"scene.toml:1", "must be given"});
  expect_part_error("part = 3\n", {"scene.toml:1", "list of tables"});
  expect_part_error("part = []\n", {"scene.toml:1"});
  expect_part_error(part + "[brdf]\ndistribution = \"vmf\"\n[[part]]\nsurface = { name = \"tiles\" }\n",
                    {"has lobes of its own, of another distribution"});
}

}  // namespace
}  // namespace footprint
