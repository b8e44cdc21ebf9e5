// Bakes that are read back from their files: the same values and the same picture for every method, one error for every
// difference, and none but errors for damaged files.
#include "renderer/baked_files/bake_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <random>

#include "renderer/core/error.hpp"
#include "renderer/scene/geometry.hpp"
#include "tests/methods/bare_renderer.hpp"
#include "tests/methods/exported_bake.hpp"
#include "tests/support/damaged_text.hpp"
#include "tests/support/fresh_folder.hpp"
#include "tests/support/says.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

namespace fs = std::filesystem;
using Manifest = nlohmann::ordered_json;
using test::says;

constexpr glm::ivec2 small_frame{24, 24};

std::string content_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void replace_content(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary | std::ios::trunc).write(text.data(), static_cast<std::streamsize>(text.size()));
}

fs::path written(const ExportedBake& bake) {
  fs::path folder = test::fresh_folder();
  write_bake(bake.files(), folder);
  return folder;
}

// The bake of a run that has the folder.
BakedMethod read_back(const fs::path& path, const ExportedBake& bake) {
  const BakeFolder folder(path);
  BakedMethod made = make_bake(*bake.baked.method, bake.spec);
  folder.require_fit(made, bake.scene, bake.effects);
  made.given_by = path.string();
  const BakedMethod wanted = made;
  bake_materials(made, bake.scene, bake.effects, no_progress,
                 {.given = [&](std::size_t i) { return folder.read(wanted, bake.scene, i, bake.effects); }},
                 [](std::size_t) {});
  return made;
}

Image picture_of(const BakedMethod& baked, const ExportedBake& bake) {
  GpuScene gpu_scene(shared_context().info(), bake.scene, bake.effects);
  const GpuMethod gpu(gpu_scene, baked);
  const FrameRenderer frames(shared_context().info(), gpu_scene, gpu, small_frame, {.footprint = exported_filter});
  return frames.render({.size = small_frame, .camera = bake.scene.camera});
}

void expect_equal_bakes(const ExportedBake& bake) {
  const fs::path path = written(bake);
  BakedMethod again = read_back(path, bake);
  const BakedMethod own = footprint::bake(*bake.baked.method, bake.spec, bake.scene, bake.effects, no_progress);
  EXPECT_EQ(picture_of(again, bake), picture_of(own, bake));
  EXPECT_TRUE(again.cached);
  ASSERT_EQ(again.materials.size(), bake.baked.materials.size());
  for (std::size_t i = 0; i < again.materials.size(); ++i) {
    ASSERT_FALSE(again.materials[i].notes.empty());
    EXPECT_EQ(again.materials[i].notes.back(), "maps from " + path.string());
    again.materials[i].notes.pop_back();
    EXPECT_EQ(again.materials[i].notes, bake.baked.materials[i].notes);
    EXPECT_EQ(again.materials[i], bake.baked.materials[i]) << bake.scene.materials[i].name;
  }
}

class BakesReadBack : public ::testing::TestWithParam<const Method*> {};

TEST_P(BakesReadBack, AreTheMethodsOwn) {
  const MethodInfo& info = GetParam()->info;
  expect_equal_bakes(ExportedBake(rough_square(info.slow_precompute ? 16 : 32), info.name));
}

INSTANTIATE_TEST_SUITE_P(Registry, BakesReadBack, ::testing::ValuesIn(all_methods().begin(), all_methods().end()),
                         [](const auto& each) { return each.param->info.name; });

TEST(BakeFolder, HasEveryStorage) {
  for (const std::string text :
       {"lean:storage=fp16", "toksvig:storage=unorm8", "toksvig:storage=bc1", "naive_mip:storage=bc5",
        "xu_vmf:j=4:storage=fp16", "xu_vmf:j=1:conversion=table", "xu_vmf:j=8:rebuild=changed"})
    expect_equal_bakes(ExportedBake(rough_square(), text));
}

// Coordinates of every kind, a second set that the model's file counts as its fourth, and a note of the method.
TEST(BakeFolder, HasCoordinatesAndNotes) {
  Scene scene = rough_square();
  TextureCoordinates& coordinates = scene.materials.front().normal_map->coordinates;
  coordinates.set = 1;
  coordinates.texcoord = 3;
  coordinates.transform = {0.5F, 0.125F, -0.25F, 2.0F, 0.1F, -0.3F};
  coordinates.wrap = {Wrap::mirrored_repeat, Wrap::clamp_to_edge};
  const ExportedBake bake(scene, "xu_vmf");
  EXPECT_FALSE(bake.baked.materials.front().notes.empty());
  expect_equal_bakes(bake);
  expect_equal_bakes(ExportedBake(scene, "toksvig"));
}

Scene two_materials() {
  Scene scene = rough_square();
  scene.materials.push_back(scene.materials.front());
  scene.materials.back().name = "other \xFF";  // not UTF-8
  scene.materials.back().roughness = 0.25F;
  scene.meshes.push_back(scene.meshes.front());
  scene.meshes.back().material = 1;
  for (Vertex& vertex : scene.meshes.back().vertices) vertex.position.z -= 0.5F;
  return scene;
}

TEST(BakeFolder, HasSeveralMaterials) { expect_equal_bakes(ExportedBake(two_materials(), "lean")); }

// A method whose maps no other has: vectors, coordinates of the surface.
TEST(BakeFolder, HasVectorsAndSurfaceCoordinates) {
  ExportedBake bake(rough_square(), "toksvig");
  Prefiltered& maps = bake.baked.materials.front();
  maps.scalars["height"] = -0.1F;
  maps.vectors["directions"] = {{0.1F, 1e-30F}, {-3.0F, 0.0F}};
  for (int i = 0; i < 9; ++i) maps.vectors["directions"].emplace_back(i, 0.5F);
  maps.surface_coordinates.emplace();
  for (const Vertex& vertex : collect_triangles(bake.scene, 0).vertices)
    maps.surface_coordinates->push_back(vertex.uv0);
  const fs::path path = written(bake);
  EXPECT_EQ(BakeFolder(path).read(bake.baked, bake.scene, 0, bake.effects), maps);
}

TEST(BakeFolder, AChangedTexelChangesThePicture) {
  const ExportedBake bake(rough_square(), "toksvig");
  const fs::path path = written(bake), map = path / "maps/square/lobe_variance.ktx2";
  const std::vector<PrefilteredTexture>& textures = bake.baked.materials.front().textures;
  const auto texture = std::ranges::find(textures, "lobe_variance", &PrefilteredTexture::name);
  ASSERT_EQ(texture->storage, Storage::fp32);
  const std::string before = content_of(map), eighth("\0\0\0\x3E", 4);
  const auto at =
      ktx2_offsets(std::span(reinterpret_cast<const std::uint8_t*>(before.data()), before.size()), *texture);
  std::string text = before;
  for (std::size_t i = 0; i < texture->levels[0].bytes.size(); i += 4) text.replace(at[0] + i, 4, eighth);
  replace_content(map, text);
  EXPECT_NE(picture_of(read_back(path, bake), bake), picture_of(bake.baked, bake));
  replace_content(map, before);
  EXPECT_EQ(picture_of(read_back(path, bake), bake), picture_of(bake.baked, bake));
}

// Maps of xu_vmf are shown as they are: no frame builds them again.
TEST(BakeFolder, AChangedMapOfAFrameBuildStays) {
  const ExportedBake bake(rough_square(), "xu_vmf:j=1");
  ExportedBake changed = bake;
  for (TextureLevel& level : changed.baked.materials.front().textures.front().levels) std::ranges::fill(level.bytes, 0);
  const BakedMethod again = read_back(written(changed), bake);
  EXPECT_FALSE(GpuMethod(GpuScene(shared_context().info(), bake.scene, bake.effects), again).has_frame_build());
  EXPECT_NE(picture_of(again, bake), picture_of(read_back(written(bake), bake), bake));
}

// Manifests of versions without the optional members.
TEST(BakeFolder, TakesOlderManifests) {
  const ExportedBake bake(rough_square(), "lean");
  const fs::path path = written(bake);
  Manifest manifest = Manifest::parse(content_of(path / "manifest.json"));
  manifest["tool"]["version"] = "0.0.1";
  manifest["options"].erase("storage");  // an option that came later
  for (Manifest& material : manifest["materials"]) {
    material.erase("method_notes");
    for (Manifest& texture : material["textures"]) {
      texture.erase("lookup");
      texture["coordinates"].erase("vertex_set");
    }
  }
  replace_content(path / "manifest.json", manifest.dump());
  EXPECT_EQ(picture_of(read_back(path, bake), bake), picture_of(bake.baked, bake));
}

std::string refusal_of(const std::function<void()>& read) {
  try {
    read();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage) << error.what();
    EXPECT_FALSE(error.hint().empty()) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return {};
}

// The error for a run over `scene` by `text`, with the maps of `bake` after `change` of its manifest.
std::string refusal_of_change(const ExportedBake& bake, const std::function<void(Manifest& manifest)>& change) {
  const fs::path path = written(bake);
  Manifest manifest = Manifest::parse(content_of(path / "manifest.json"));
  change(manifest);
  replace_content(path / "manifest.json", manifest.dump());
  return refusal_of([&] { (void)read_back(path, bake); });
}

std::string refusal_for(const ExportedBake& bake, const ExportedBake& run) {
  const fs::path path = written(bake);
  return refusal_of([&] { (void)read_back(path, run); });
}

TEST(BakeFolder, RefusesAnotherMethodOrScene) {
  const ExportedBake bake(rough_square(), "toksvig");
  EXPECT_TRUE(says(refusal_for(bake, ExportedBake(rough_square(), "lean")), "the maps are of `toksvig`, not of lean"));
  EXPECT_TRUE(says(refusal_for(bake, ExportedBake(rough_square(), "toksvig:storage=fp16")),
                   "option storage is fp32 there and fp16 here"));
  EXPECT_TRUE(says(refusal_for(bake, ExportedBake(two_materials(), "toksvig")), "for 1 materials (square)"));
  Scene renamed = rough_square();
  renamed.materials.front().name = "steel";
  EXPECT_TRUE(says(refusal_for(bake, ExportedBake(renamed, "toksvig")), "and the scene has 1 (steel)"));
  Scene other_lobe = rough_square();
  NormalDistribution& distribution = other_lobe.materials.front().brdf.distribution;
  distribution = distribution == NormalDistribution::ggx ? NormalDistribution::beckmann : NormalDistribution::ggx;
  EXPECT_TRUE(says(refusal_for(bake, ExportedBake(other_lobe, "toksvig")), "base BRDF: distribution is"));
  ExportedBake without = bake;
  without.effects.reset(static_cast<std::size_t>(Effect::roughness_variation));
  EXPECT_TRUE(says(refusal_for(bake, without), "the maps are for roughness_variation too"));
  EXPECT_TRUE(says(refusal_for(bake, without), "leave out the options"));
}

TEST(BakeFolder, RefusesManifestsThatAreWrong) {
  const ExportedBake bake(rough_square(), "toksvig");
  const auto texture = [](Manifest& manifest) -> Manifest& { return manifest["materials"][0]["textures"][0]; };
  const std::vector<std::pair<std::string, std::function<void(Manifest&)>>> rows{
      {"schema: is not `footprint-bake/1`", [](Manifest& m) { m["schema"] = "footprint-bake/9"; }},
      {"materials: is missing", [](Manifest& m) { m.erase("materials"); }},
      {"materials[0]: is not an object", [](Manifest& m) { m["materials"][0] = 1; }},
      {"textures: is not a list", [](Manifest& m) { m["materials"][0]["textures"] = "none"; }},
      {"textures[0], name: `a; discard`", [&](Manifest& m) { texture(m)["name"] = "a; discard"; }},
      {"unknown storage `fp64`", [&](Manifest& m) { texture(m)["storage"] = "fp64"; }},
      {"channels: is not a whole number from 1 to 4", [&](Manifest& m) { texture(m)["channels"] = 5; }},
      {"layers: is not a whole number", [&](Manifest& m) { texture(m)["layers"] = 1e9; }},
      {"levels: level 1 is 3x3",
       [&](Manifest& m) {
         texture(m)["levels"][1] = {3, 3};
       }},
      {"levels: is not a whole number",
       [&](Manifest& m) {
         texture(m)["levels"][0] = {1 << 30, 1};
       }},
      {"levels: is empty", [&](Manifest& m) { texture(m)["levels"] = Manifest::array(); }},
      {"levels: has 2 items",
       [&](Manifest& m) { texture(m)["levels"].erase(texture(m)["levels"].begin() + 2, texture(m)["levels"].end()); }},
      {"pixelWidth is 32, and 64 was expected",
       [&](Manifest& m) {
         texture(m)["levels"] = Manifest::array({Manifest::array({64, 32})});
       }},
      {"below the manifest's folder", [&](Manifest& m) { texture(m)["ktx2"] = "../map.ktx2"; }},
      {"below the manifest's folder", [&](Manifest& m) { texture(m)["ktx2"] = "/etc/passwd"; }},
      {"missing.ktx2: is missing", [&](Manifest& m) { texture(m)["ktx2"] = "missing.ktx2"; }},
      {"vertex_set: is not a whole number", [&](Manifest& m) { texture(m)["coordinates"]["vertex_set"] = 2; }},
      {"transform: has 2 items, not 3",
       [&](Manifest& m) {
         texture(m)["coordinates"]["transform"] = {{1, 0}, {0, 1}};
       }},
      {"lookup: unknown word `cubic`", [&](Manifest& m) { texture(m)["lookup"] = "cubic"; }},
      {"lookup: is missing",
       [&](Manifest& m) {
         texture(m).erase("lookup");
         texture(m)["filter"] = "linear";
       }},
      {"lacks `lobe_cutoff`", [](Manifest& m) { m["materials"][0]["uniforms"].erase("lobe_cutoff"); }},
      {"`two` is none of the material",
       [](Manifest& m) {
         m["materials"][0]["uniforms"]["two[0]"] = {1, 2, 3};
       }},
      {"does not fit a 32-bit float", [](Manifest& m) { m["materials"][0]["uniforms"]["one"] = 1e300; }},
      {"surface_coordinates: has 1 items",
       [](Manifest& m) {
         m["materials"][0]["surface_coordinates"] = Manifest::array({Manifest::array({0, 0})});
       }},
      {"nested more than", [](Manifest& m) {
         for (int i = 0; i < 100; ++i) m = Manifest::array({m});
       }}};
  for (const auto& [words, change] : rows) EXPECT_TRUE(says(refusal_of_change(bake, change), words));
}

TEST(BakeFolder, RefusesMapsThatTheModuleDoesNotDeclare) {
  const ExportedBake bake(rough_square(), "toksvig");
  const fs::path path = written(bake);
  Manifest manifest = Manifest::parse(content_of(path / "manifest.json"));
  manifest["materials"][0]["textures"][0]["name"] = "another";
  replace_content(path / "manifest.json", manifest.dump());
  const BakedMethod again = read_back(path, bake);
  const std::string refusal = refusal_of([&] { (void)picture_of(again, bake); });
  EXPECT_TRUE(says(refusal, path.string() + ": its maps do not fit the method's module"));
}

TEST(BakeFolder, RefusesMaterialsThatDiffer) {
  const std::string refusal = refusal_of_change(ExportedBake(two_materials(), "toksvig"), [](Manifest& manifest) {
    manifest["materials"][1]["textures"].erase(std::size_t{0});
  });
  EXPECT_TRUE(says(refusal, "those of the first material are"));
}

// Any outcome but an error of the user is a failure, and so is a crash.
void expect_no_crash(const fs::path& path, const ExportedBake& bake) {
  try {
    (void)read_back(path, bake);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage) << error.what();
  }
}

TEST(BakeFolder, SurvivesDamage) {
  const ExportedBake bake(rough_square(8), "toksvig:storage=unorm8");
  const fs::path path = written(bake);
  std::mt19937 random(1);
  for (const fs::path& file : {path / "manifest.json", path / "maps/square/mean_normal.ktx2"}) {
    const std::string whole = content_of(file);
    for (std::size_t size = 0; size + 1 < whole.size(); size += size < 400 ? 1 : 61) {
      replace_content(file, whole.substr(0, size));
      EXPECT_THROW((void)read_back(path, bake), Error) << file << " of " << size << " bytes";
    }
    for (int i = 0; i < 1000; ++i) {
      replace_content(file, test::damaged(whole, random));
      expect_no_crash(path, bake);
    }
    for (std::size_t at = 0; at < std::min<std::size_t>(whole.size(), 400); ++at) {
      std::string flipped = whole;
      flipped[at] = static_cast<char>(flipped[at] ^ (1 << (at % 8)));
      replace_content(file, flipped);
      expect_no_crash(path, bake);
    }
    replace_content(file, whole);
  }
}

TEST(BakeFolder, ItsContentIsThatOfItsTexels) {
  const fs::path path = written(ExportedBake(rough_square(8), "toksvig"));
  const std::string before = BakeFolder(path).content();
  EXPECT_EQ(BakeFolder(path).content(), before);
  const fs::path map = path / "maps/square/mean_normal.ktx2";
  std::string text = content_of(map);
  text.back() = static_cast<char>(text.back() ^ 1);
  replace_content(map, text);
  EXPECT_NE(BakeFolder(path).content(), before);
}

}  // namespace
}  // namespace footprint::testing
