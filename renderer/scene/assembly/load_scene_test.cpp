// From the SCENE argument to a whole Scene: names, overrides, and what is supplied.
#include "renderer/scene/assembly/load_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/image/image_io.hpp"
#include "tests/support/fresh_folder.hpp"
#include "tests/support/gltf_builder.hpp"
#include "tests/support/says.hpp"
#include "tests/support/source_folder.hpp"

namespace footprint {
namespace {

const SceneLibrary library{.folder = testing::source_folder() / "scenes", .surfaces = {}};

Scene load_made(const std::string& settings) {
  return load_scene(test::write_file("made/scene.toml", settings).string(), {});
}

TEST(LoadScene, ScenesOfTheRepositoryAreListedAndLoad) {
  const auto names = list_scenes(library.folder);
  EXPECT_TRUE(std::ranges::is_sorted(names));
  EXPECT_TRUE(std::ranges::find(names, "ribbed_plane") != names.end());
  EXPECT_TRUE(std::ranges::find(names, "clear_coat") != names.end());
  EXPECT_TRUE(list_scenes("/nowhere/at/all").empty());

  const Scene by_name = load_scene("ribbed_plane", library);
  EXPECT_EQ(by_name.name, "ribbed_plane");
  EXPECT_EQ(by_name.source, "ribbed_plane");
  for (const auto& path : {library.folder / "ribbed_plane", library.folder / "ribbed_plane/scene.toml"}) {
    EXPECT_EQ(load_scene(path.string(), {}).name, "ribbed_plane");
  }
  EXPECT_TRUE(by_name.defaults.empty());
  EXPECT_TRUE(by_name.warnings.empty());
  EXPECT_EQ(by_name.materials.at(0).lobe_parameter, 64.0F);
  EXPECT_EQ(by_name.materials.at(0).metallic, 0.0F);
}

TEST(LoadScene, RibbedPlaneHasTheNormalsOfItsFormula) {
  const Scene scene = load_scene("ribbed_plane", library);
  const Image map = scene.materials.at(0).normal_map->image.decoded();
  ASSERT_EQ(map.width, 128);
  constexpr double pi = 3.14159265358979323846;
  for (const auto& [column, row] : {std::pair{0, 0}, {5, 17}, {100, 90}}) {
    const double x = (column + 0.5) / 128, y = 1 - (row + 0.5) / 128;
    const double phase = 2 * pi * (8 * x + std::sin(2 * pi * y) / 4);
    const double dx = -0.9 * std::sin(phase), dy = dx / 8 * pi / 2 * std::cos(2 * pi * y);
    const double length = std::sqrt(dx * dx + dy * dy + 1);
    EXPECT_NEAR(map.at(column, row)[0], -dx / length, 0.005);
    EXPECT_NEAR(map.at(column, row)[1], -dy / length, 0.005);
    EXPECT_NEAR(map.at(column, row)[2], 1 / length, 0.005);
  }
}

TEST(LoadScene, WrongNamesAreNamed) {
  const auto error_of = [](const std::string& name) {
    return test::usage_error([&] { return load_scene(name, library); });
  };
  EXPECT_NE(error_of("ribed_plane").find("did you mean `ribbed_plane`"), std::string::npos);
  EXPECT_NE(error_of("").find("empty"), std::string::npos);
  EXPECT_NE(error_of("nowhere.gltf").find("no such file"), std::string::npos);
  EXPECT_NE(error_of("nowhere/scene.toml").find("no such file"), std::string::npos);
  EXPECT_NE(error_of(test::process_folder().string()).find("no scene.toml"), std::string::npos);
  EXPECT_NE(error_of(test::write_file("model.stl", "solid").string()).find("neither"), std::string::npos);
}

TEST(LoadScene, BareGltfGetsCameraLightsEnvironmentAndExposure) {
  const Scene scene = load_scene(test::make_quad().write().string(), {});
  EXPECT_EQ(scene.name, "made");
  EXPECT_EQ(scene.defaults.size(), 4U);
  EXPECT_EQ(scene.lights.size(), 3U);
  ASSERT_TRUE(scene.environment);
  EXPECT_EQ(scene.environment->name, "studio");
  EXPECT_EQ(scene.exposure, 1.0F);
  EXPECT_EQ(scene.distances, std::vector<double>{1.0});
  EXPECT_EQ(scene.bounds.lower, glm::vec3(-1, -1, 0));
  EXPECT_EQ(scene.bounds.upper, glm::vec3(1, 1, 0));
  EXPECT_GT(scene.camera.world[3].z, 2.0F);
}

TEST(LoadScene, OwnLightsLeaveTheExposureAutomatic) {
  test::GltfBuilder quad = test::make_quad();
  quad.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "directional"}}};
  quad.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
  const auto file = quad.write();
  const Scene bare = load_scene(file.string(), {});
  EXPECT_EQ(bare.lights.size(), 1U);
  EXPECT_FALSE(bare.environment);
  EXPECT_FALSE(bare.exposure);
  EXPECT_EQ(bare.defaults.size(), 1U);

  const std::string model = "[model]\nfile = \"../made.gltf\"\n";
  const std::string light = "[[light]]\ntype = \"point\"\nposition = [0, 0, 1]\n";
  EXPECT_EQ(load_made(model + light).lights.size(), 2U);
  EXPECT_EQ(load_made(model + light + "[lights]\nkeep = false\n").lights.size(), 1U);
  EXPECT_EQ(load_made(model + "[lights]\nkeep = false\n").lights.size(), 3U);  // the supplied rig
}

TEST(LoadScene, AnEnvironmentFromOutsideGoesBeforeTheScenesOwn) {
  Image radiance(2, 1, 3, 0.5F);
  write_exr(test::process_folder() / "around.exr", radiance);
  SceneOverrides overrides;
  overrides.environment = test::process_folder() / "around.exr";
  const Scene bare = load_scene(test::make_quad().write().string(), {}, overrides);
  EXPECT_EQ(bare.environment->name, "around.exr");
  EXPECT_TRUE(bare.lights.empty());
  const auto file = test::write_file("lit.toml", "[plane]\n[environment]\nkind = \"sky\"\nintensity = 9.0\n");
  EXPECT_EQ(load_scene(file.string(), {}, overrides).environment->name, "around.exr");
  EXPECT_EQ(load_scene(file.string(), {}, overrides).environment->radiance->texels.front(), 0.5F);
  overrides.environment = "missing.exr";
  EXPECT_NE(test::usage_error([&] { return load_scene(file.string(), {}, overrides); }).find("missing.exr"),
            std::string::npos);
}

// Model files alone have an open horizon; what papers have computed or traced has a cut one; a scene may say either.
TEST(LoadScene, TheHorizonFollowsWhatIsDrawn) {
  const std::string model = "[model]\nfile = \"../made.gltf\"\n";
  EXPECT_EQ(load_scene(test::make_quad().write().string(), {}).horizon, Horizon::open);
  EXPECT_FALSE(load_scene(test::make_quad().write().string(), {}).shadows.both_sides);
  EXPECT_EQ(load_made(model).horizon, Horizon::open);
  EXPECT_FALSE(load_made(model).shadows.both_sides);
  EXPECT_TRUE(load_made(model + "[shadows]\nsides = \"both\"\n").shadows.both_sides);
  EXPECT_TRUE(load_made("[plane]\n").shadows.both_sides);
  EXPECT_FALSE(load_made("[plane]\n[shadows]\nsides = \"drawn\"\n").shadows.both_sides);
  EXPECT_EQ(load_made("[scene]\nhorizon = \"cut\"\n" + model).horizon, Horizon::cut);
  EXPECT_EQ(load_made("[plane]\n").horizon, Horizon::cut);
  EXPECT_EQ(load_made("[scene]\nhorizon = \"open\"\n[plane]\n").horizon, Horizon::open);
  const std::string patch = "[microgeometry]\nkind = \"grooves\"\nresolution = 8\n";
  EXPECT_EQ(load_made(model + patch).horizon, Horizon::cut);
  const auto refused = [&] { return load_made("[scene]\nhorizon = \"open\"\n[plane]\n" + patch); };
  EXPECT_NE(test::usage_error(refused).find("knows no light from below"), std::string::npos);
}

TEST(LoadScene, SettingsOverrideEveryMaterial) {
  write_png(test::process_folder() / "made/grey.png", Image(4, 2, 3, 0.5F));
  const std::string plane =
      "[plane]\nsize = [4, 2]\nnormal_map = \"grey.png\"\nbase_color_map = \"grey.png\"\n"
      "metallic_roughness_map = \"grey.png\"\nroughness = 0.5\nmetallic = 1\n[tiling]\nuv = [3, 5]\n";
  const Material as_given = load_made(plane).materials.at(0);
  ASSERT_TRUE(as_given.normal_map && as_given.base_color_map && as_given.metallic_roughness_map);
  EXPECT_EQ(as_given.normal_map->coordinates.transform * glm::vec3(1, 1, 1), glm::vec2(3, 5));
  EXPECT_NEAR(as_given.metallic_roughness_map->image.decoded().texels[0], 0.25F, 0.002F);
  EXPECT_EQ(as_given.brdf, BaseBrdf{});

  const Material changed = load_made(plane +
                                     "[brdf]\ndistribution = \"vmf\"\ngeometry = \"none\"\nfresnel = \"none\"\n"
                                     "diffuse = false\nkappa = 100\nspecular = [1, 1, 1]\nbase_color = [0, 1, 0]\n")
                               .materials.at(0);
  EXPECT_EQ(changed.brdf, (BaseBrdf{NormalDistribution::vmf, GeometryTerm::none, FresnelTerm::none, false}));
  EXPECT_EQ(changed.lobe_parameter, 100.0F);
  EXPECT_EQ(changed.metallic, 0.0F);
  EXPECT_FALSE(changed.base_color_map || changed.metallic_roughness_map);
  EXPECT_EQ(changed.base_color, glm::vec4(0, 1, 0, 1));
}

TEST(LoadScene, ModelsThatAreNotInstalledNameTheirPackage) {
  const auto error_of = [](const std::string& settings) {
    return test::usage_error([&] { return load_made(settings); });
  };
  const std::string package = "package = \"some-models\"\n";
  EXPECT_NE(error_of("[model]\nfile = \"missing.gltf\"\n" + package).find("install the package some-models"),
            std::string::npos);
  const std::string several = "[model]\nfiles = [\"missing.gltf\", \"gone.glb\"]\n";
  EXPECT_NE(error_of(several + package).find("install the package some-models"), std::string::npos);
  EXPECT_NE(error_of(several).find("none of these files exists"), std::string::npos);
  (void)test::make_quad().write();
  EXPECT_EQ(load_made("[model]\nfiles = [\"missing.gltf\", \"../made.gltf\"]\n").meshes.size(), 1U);
}

TEST(LoadScene, ScenesWithoutATriangleAreRefused) {
  test::GltfBuilder quad = test::make_quad();
  quad.json["nodes"][0].erase("mesh");
  const auto file = quad.write().string();
  EXPECT_NE(test::usage_error([&] { return load_scene(file, {}); }).find("no triangle"), std::string::npos);
}

// Why there is none: meshes hidden by their own node or one above, and what is left out.
TEST(LoadScene, ScenesWithoutATriangleSayWhy) {
  const auto error_of = [](test::GltfBuilder quad) {
    const auto file = quad.write().string();
    return test::usage_error([&] { return load_scene(file, {}); });
  };
  test::GltfBuilder hidden = test::make_quad();
  hidden.json["extensionsUsed"] = {"KHR_node_visibility"};
  hidden.json["nodes"][0]["extensions"]["KHR_node_visibility"]["visible"] = false;
  EXPECT_TRUE(test::says(error_of(hidden), "hidden by KHR_node_visibility"));
  hidden.json["nodes"].push_back(hidden.json["nodes"][0]);
  hidden.json["nodes"][1].erase("extensions");
  hidden.json["nodes"][0].erase("mesh");
  hidden.json["nodes"][0]["children"] = {1};
  EXPECT_TRUE(test::says(error_of(hidden), "hidden by KHR_node_visibility"));
  test::GltfBuilder lines = test::make_quad();
  lines.json["meshes"][0]["primitives"][0]["mode"] = 1;
  EXPECT_TRUE(test::says(error_of(lines), "lines"));
}

// Maps of a plane and an environment, which do not move.
TEST(LoadScene, WhatWasReadIsNotReadAgain) {
  const Image normals(2, 2, 3, 0.5F);
  const auto map = test::process_folder() / "made/flat.png", around = test::process_folder() / "made/around.exr";
  const auto file =
      test::write_file("made/still.toml", "[plane]\nnormal_map = \"flat.png\"\n[environment]\nfile = \"around.exr\"\n");
  write_png(map, normals);
  write_exr(around, Image(2, 1, 3, 0.5F));
  const SceneSource source = read_scene(file.string(), {});
  SceneFiles files;
  const Scene first = assemble(source, files);
  std::filesystem::remove(map);
  std::filesystem::remove(around);
  const Scene again = assemble(source, files);
  EXPECT_EQ(again.materials.at(0).normal_map->image, first.materials.at(0).normal_map->image);
  EXPECT_EQ(again.environment->radiance, first.environment->radiance);
  EXPECT_EQ(again.warnings, first.warnings);
  EXPECT_NE(test::usage_error([&] { return assemble(source); }).find("flat.png"), std::string::npos);
}

TEST(LoadScene, BrokenMapsOfAPlaneAreNamed) {
  test::write_file("made/words.png", "no image");
  for (const char* name : {"missing.png", "words.png"}) {
    const std::string error =
        test::usage_error([&] { return load_made(std::string("[plane]\nnormal_map = \"") + name + "\"\n"); });
    EXPECT_NE(error.find(name), std::string::npos) << error;
  }
}

}  // namespace
}  // namespace footprint
