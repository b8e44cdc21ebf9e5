// All glTF files of Debian's assimp-testmodels, sound and hostile: each loads or gives a clear error.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "renderer/core/error.hpp"
#include "renderer/scene/assembly/load_scene.hpp"

namespace footprint {
namespace {

const std::filesystem::path models = "/usr/share/assimp/models";

/// "" where the file loads, else the error's text.
std::string outcome(const std::filesystem::path& file) {
  try {
    const Scene scene = load_scene(file.string(), {});
    EXPECT_FALSE(scene.meshes.empty()) << file;
    EXPECT_FALSE(scene.lights.empty()) << file;
    return {};
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage) << error.what();
    EXPECT_FALSE(error.place().empty()) << error.what();
    return error.what();
  }
}

TEST(GltfPackage, EveryFileLoadsOrGivesAClearError) {
  if (!std::filesystem::exists(models)) GTEST_SKIP() << "the package assimp-testmodels is not installed";
  int loaded = 0;
  for (const char* folder : {"glTF", "glTF2"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(models / folder)) {
      const auto extension = entry.path().extension();
      if (extension != ".gltf" && extension != ".glb") continue;
      const std::string error = outcome(entry.path());
      loaded += error.empty() ? 1 : 0;
      RecordProperty(fmt::format("file_{}", entry.path().stem().string()), error.empty() ? "loaded" : error);
    }
  }
  EXPECT_GT(loaded, 15);
}

TEST(GltfPackage, HostileFilesSayWhatIsWrong) {
  if (!std::filesystem::exists(models)) GTEST_SKIP() << "the package assimp-testmodels is not installed";
  const std::map<std::string, std::string> expected{
      {"glTF2/BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb", "not finite"},
      {"glTF2/IndexOutOfRange/IndexOutOfRange.gltf", "names vertex"},
      {"glTF2/IndexOutOfRange/AllIndicesOutOfRange.gltf", "names vertex"},
      {"glTF2/MissingBin/BoxTextured.gltf", "BoxTextured0.bin"},
      {"glTF2/RecursiveNodes/RecursiveNodes.gltf", "reached twice"},
      {"glTF2/SchemaFailures/sceneWrongType.gltf", "scene: must be"},
      {"glTF2/wrongTypes/badUint.gltf", "baseColorTexture.index: index -1 is out of range"},
      {"glTF2/TestNoRootNode/SceneWithoutNodes.gltf", "no triangle"},
      {"glTF/TwoBoxes/TwoBoxes.gltf", "asset.version"}};
  for (const auto& [file, words] : expected) {
    EXPECT_NE(outcome(models / file).find(words), std::string::npos) << file << ": " << outcome(models / file);
  }
}

TEST(GltfPackage, ClearCoatTestLoadsWhole) {
  const auto file = models / "glTF2/ClearCoat-glTF/ClearCoatTest.gltf";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "the package assimp-testmodels is not installed";
  const Scene scene = load_scene(file.string(), {});
  std::size_t triangles = 0;
  for (const Mesh& mesh : scene.meshes) triangles += mesh.indices.size() / 3;
  EXPECT_GT(triangles, 30000U);
  EXPECT_TRUE(std::ranges::any_of(scene.materials, [](const Material& m) { return m.normal_map.has_value(); }));
  const auto count = [&](auto condition) { return std::ranges::count_if(scene.materials, condition); };
  EXPECT_GT(count([](const Material& m) { return m.coat && m.coat->roughness_map; }), 0);
  EXPECT_GT(count([](const Material& m) { return m.coat && m.coat->normal_map; }), 0);
  EXPECT_GT(count([](const Material& m) { return !m.coat; }), 0);
  EXPECT_FALSE(std::ranges::any_of(
      scene.warnings, [](const std::string& warning) { return warning.find("clearcoat") != std::string::npos; }));
  EXPECT_EQ(scene.defaults.size(), 4U);
}

}  // namespace
}  // namespace footprint
