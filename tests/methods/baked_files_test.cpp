// The files of `footprint bake`: a renderer that has only the files draws Footprint's own picture, for every method
// whose maps are baked.
#include "renderer/baked_files/baked_files.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "methods/registry.hpp"
#include "renderer/core/error.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/image/mipmap.hpp"
#include "renderer/pipeline/surface_program.hpp"
#include "tests/methods/bare_renderer.hpp"
#include "tests/methods/exported_bake.hpp"
#include "tests/support/fresh_folder.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/says.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

namespace fs = std::filesystem;

constexpr glm::ivec2 frame{32, 32};
constexpr FootprintFilter filter = exported_filter;

using Bake = ExportedBake;

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

Scene dark(Scene scene) {
  std::get<PointLight>(scene.lights.front()).intensity = {};
  return scene;
}

// The largest difference over the larger of 1 and the picture's largest value.
double difference_from_the_pipeline(const std::string& text, MapFiles maps) {
  const bool is_slow = find_method(parse_methods(text).front().name).info.slow_precompute;
  const Bake bake(rough_square(is_slow ? 16 : 32), text);
  const fs::path folder = test::fresh_folder();
  write_bake(bake.files(), folder);
  const Image own = TestRenderer(bake.scene, frame).frame(find_method(bake.spec), text, filter);
  EXPECT_GT(std::ranges::max(own.texels), 0.1F);
  return largest_difference(render_from_files(folder, bake.scene, frame, maps), own);
}

class BakedFiles : public ::testing::TestWithParam<const Method*> {};

TEST_P(BakedFiles, AloneDrawFootprintsPicture) {
  const std::string& name = GetParam()->info.name;
  EXPECT_LT(difference_from_the_pipeline(name, MapFiles::exr), 1e-3);
  EXPECT_LT(difference_from_the_pipeline(name, MapFiles::ktx2), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Registry, BakedFiles, ::testing::ValuesIn(all_methods().begin(), all_methods().end()),
                         [](const auto& each) { return each.param->info.name; });

// A mesh whose normals turn from vertex to vertex, as a screen-space filter sees them, and presets of every kind.
TEST(BakedFilesOf, ScreenFiltersDrawFootprintsPicture) {
  Scene scene = rough_square();
  for (Vertex& vertex : scene.meshes.front().vertices)
    vertex.normal = glm::normalize(vertex.normal + 4.0F * glm::vec3(vertex.uv0 - 0.5F, 0.0F));
  std::get<PointLight>(scene.lights.front()).intensity *= 10.0F;
  for (const std::string text :
       {"specular_aa:preset=filament", "specular_aa:preset=o3de", "specular_aa:preset=three:bake=unity",
        "specular_aa:preset=babylon", "specular_aa:preset=tokuyoshi_kaplanyan_2021"}) {
    const Bake bake(scene, text);
    const fs::path folder = test::fresh_folder();
    write_bake(bake.files(), folder);
    const Image own = TestRenderer(scene, frame).frame(find_method("specular_aa"), text, filter);
    EXPECT_LT(largest_difference(render_from_files(folder, scene, frame, MapFiles::exr), own), 1e-3) << text;
    const Image unwidened = TestRenderer(scene, frame).frame(find_method("naive_mip"), {}, filter);
    EXPECT_GT(largest_difference(own, unwidened), 5e-3) << text;  // there is something to see
  }
}

// The result of a frame build is baked once for all views; maps in camera space are not baked.
TEST(BakedFilesOf, BuiltMapsDrawFootprintsPicture) {
  for (const std::string text : {"xu_vmf:j=4:storage=fp16", "xu_vmf:j=1:conversion=table"})
    EXPECT_LT(difference_from_the_pipeline(text, MapFiles::exr), 1e-3) << text;
  Bake waiting(rough_square(), "xu_vmf");
  waiting.baked.materials.front().textures.front().built = true;
  EXPECT_THROW(require_files(waiting.files()), std::logic_error);
}

// Bytes from KTX2 alone: llvmpipe filters them in 8 bits, and the same numbers from EXR in 32.
TEST(BakedFilesOf, SmallerStoragesDrawFootprintsPicture) {
  for (const std::string text :
       {"toksvig:storage=unorm8", "lean:storage=fp16", "roughness_bake:storage=unorm8", "roughness_bake:storage=bc5",
        "toksvig:storage=bc1", "naive_mip:storage=bc5", "naive_mip:storage=bc1", "fixed_brdf:storage=bc5"})
    EXPECT_LT(difference_from_the_pipeline(text, MapFiles::ktx2), 1e-3) << text;
  EXPECT_LT(difference_from_the_pipeline("lean:storage=fp16", MapFiles::exr), 1e-3);
}

// Light that grazes the plane from below lights the bumps where the horizon is open, and nothing where it cuts.
TEST(BakedFilesOf, ModulesHaveTheScenesHorizon) {
  for (const Horizon horizon : {Horizon::open, Horizon::cut}) {
    Scene scene = rough_square();
    scene.horizon = horizon;
    std::get<PointLight>(scene.lights.front()).position = {0.0F, 4.0F, -0.5F};
    const Bake bake(scene, "toksvig");
    const fs::path folder = test::fresh_folder();
    write_bake(bake.files(), folder);
    const Image own = TestRenderer(bake.scene, frame).frame(find_method("toksvig"), {}, filter);
    const double brightest =
        largest_difference(own, TestRenderer(dark(scene), frame).frame(find_method("toksvig"), {}, filter));
    EXPECT_EQ(brightest > 1e-3F, horizon == Horizon::open) << brightest;
    EXPECT_LT(largest_difference(render_from_files(folder, bake.scene, frame, MapFiles::exr), own), 1e-3);
  }
}

// The tests above can fail: they do if one map differs.
TEST(BakedFilesOf, AnotherRoughnessDrawsAnotherPicture) {
  const Bake bake(rough_square(), "toksvig");
  const fs::path folder = test::fresh_folder();
  write_bake(bake.files(), folder);
  const fs::path map = folder / "maps/square/lobe_variance.exr";
  ExrChain chain = read_exr_chain(map);
  for (Image& level : chain.levels) {
    for (float& value : level.texels) value *= 4.0F;
  }
  write_exr_chain(map, chain, ExrTexel::full);
  const Image own = TestRenderer(bake.scene, frame).frame(find_method("toksvig"), {}, filter);
  EXPECT_GT(largest_difference(render_from_files(folder, bake.scene, frame, MapFiles::exr), own), 1e-2);
}

TEST(BakedFilesOf, HoldTheTexelsThatTheShaderReads) {
  const Bake bake(rough_square(), "lean:storage=fp16");
  const fs::path folder = test::fresh_folder();
  write_bake(bake.files(), folder);
  for (const PrefilteredTexture& texture : bake.baked.materials[0].textures) {
    const ExrChain chain = read_exr_chain(folder / "maps/square" / (texture.name + ".exr"));
    ASSERT_EQ(chain.levels.size(), texture.levels.size());
    for (std::size_t level = 0; level < chain.levels.size(); ++level)
      EXPECT_EQ(chain.levels[level], decode_level(texture, level)) << texture.name << ", level " << level;
  }
}

TEST(BakedFilesOf, BytesAreInPngToo) {
  const Bake bake(rough_square(), "naive_mip:storage=unorm8");
  const fs::path folder = test::fresh_folder();
  write_bake(bake.files(), folder);
  const PrefilteredTexture& normals = bake.baked.materials[0].textures.front();
  ASSERT_EQ(normals.storage, Storage::unorm8);
  for (std::size_t level = 0; level < normals.levels.size(); ++level) {
    const fs::path file = folder / "maps/square" / fmt::format("{}.mip{}.png", normals.name, level);
    const Image png = read_image(file, Transfer::linear), own = decode_level(normals, level);
    ASSERT_EQ(png.texels.size(), own.texels.size());
    for (std::size_t i = 0; i < own.texels.size(); ++i) EXPECT_NEAR(png.texels[i], own.texels[i], 1e-6);
  }
}

std::vector<float> read_by_mesa(const PrefilteredTexture& texture, std::size_t level) {
  constexpr std::array<GLenum, 3> read_formats{GL_RED, GL_RG, GL_RGB};
  const GpuTexture uploaded = upload(texture);
  std::vector<float> texels(decode_level(texture, level).texels.size());
  gl::api().PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl::api().GetTextureImage(uploaded.texture->name(), static_cast<GLint>(level),
                            read_formats.at(static_cast<std::size_t>(texture.channels - 1)), GL_FLOAT,
                            static_cast<GLsizei>(sizeof(float) * texels.size()), texels.data());
  return texels;
}

// Blocks as Mesa decodes them, truncated to 8 bits, which shares no code with this program; smooth values are near
// those that were encoded.
TEST(BakedFilesOf, BlocksAreReadAlikeByMesa) {
  (void)shared_context();
  for (const auto& [storage, channels] : {std::pair{Storage::bc1, 3}, {Storage::bc4, 1}, {Storage::bc5, 2}}) {
    Image smooth(22, 13, channels);
    for (std::size_t i = 0; i < smooth.texels.size(); ++i)
      smooth.texels[i] = 0.5F + 0.4F * std::sin(0.07F * static_cast<float>(i / static_cast<std::size_t>(channels)));
    const std::vector<Image> chain = mip_chain(smooth);
    const PrefilteredTexture texture = make_texture("blocks", chain, storage, {});
    for (std::size_t level = 0; level < chain.size(); ++level) {
      const Image own = decode_level(texture, level);
      const std::vector<float> texels = read_by_mesa(texture, level);
      for (std::size_t i = 0; i < texels.size(); ++i) {
        EXPECT_NEAR(texels[i], own.texels[i], 1.51 / 255) << storage_name(storage) << ", level " << level;
        EXPECT_NEAR(own.texels[i], chain[level].texels[i], 0.13) << storage_name(storage) << ", level " << level;
      }
    }
  }
}

TEST(BakedFilesOf, EqualBakesAreEqual) {
  const fs::path folder = test::fresh_folder();
  for (const char* name : {"a", "b"}) {
    fs::create_directories(folder / name);
    write_bake(Bake(rough_square(), "toksvig").files(), folder / name);
  }
  std::size_t count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder / "a")) {
    if (!entry.is_regular_file()) continue;
    EXPECT_EQ(bytes_of(entry.path()), bytes_of(folder / "b" / fs::relative(entry.path(), folder / "a")));
    ++count;
  }
  EXPECT_EQ(count, 6U);  // two maps in two files each, the module, the manifest
}

TEST(BakedFilesOf, TheManifestNamesEveryFileAndNoOther) {
  const Bake bake(rough_square(), "tan_gmm");
  const fs::path folder = test::fresh_folder();
  write_bake(bake.files(), folder);
  const auto manifest = nlohmann::json::parse(bytes_of(folder / "manifest.json"));
  std::set<std::string> named{"manifest.json", manifest["module"].get<std::string>()}, there;
  for (const auto& texture : manifest["materials"][0]["textures"]) {
    named.insert(texture["ktx2"].get<std::string>());
    for (const char* kind : {"exr", "png"}) named.insert(texture[kind].begin(), texture[kind].end());
  }
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) there.insert(fs::relative(entry.path(), folder).string());
  }
  EXPECT_EQ(named, there);
}

TEST(BakedFilesOf, NothingAreRefused) {
  const auto refusal = [](const Scene& scene, const std::string& text) {
    const fs::path folder = test::fresh_folder();
    try {
      write_bake(Bake(scene, text).files(), folder);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      EXPECT_TRUE(fs::is_empty(folder));
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_TRUE(test::says(refusal(rough_square(), "xu_vmf:space=camera"), "builds its maps for each view"));
  EXPECT_TRUE(test::says(refusal(rough_square(), "xu_vmf:space=camera"), "serve every view"));
  EXPECT_TRUE(test::says(refusal(square_scene({}, {}), "toksvig"), "do not vary on any material"));
}

}  // namespace
}  // namespace footprint::testing
