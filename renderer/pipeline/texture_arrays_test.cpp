// Array textures and texel-wise lookups through the shared shader text: layers are apart, and the texels of a footprint
// with their weights are what the sampler blends.
#include <gtest/gtest.h>

#include <array>

#include "renderer/image/mipmap.hpp"
#include "renderer/pipeline/base_surface.hpp"
#include "renderer/pipeline/gpu_scene.hpp"
#include "renderer/pipeline/shader_source.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/shader_probe.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

Prefiltered three_layers(TextureFilter filter) {
  std::vector<std::vector<Image>> layers;
  for (std::uint32_t seed = 1; seed <= 3; ++seed) layers.push_back(mip_chain(random_normals(13, 6, 0.9F, seed)));
  return {.textures = {make_array_texture("map", layers, Storage::fp32, {}, filter)}, .scalars = {}};
}

// Evaluates `expression` (a vec4 of Footprint f, int layer) for footprints given as uv, dx, dy.
std::vector<glm::vec4> looked_up(const Prefiltered& prefiltered, const std::string& expression, int layer,
                                 std::span<const std::array<glm::vec4, 3>> footprints, const FootprintFilter& filter) {
  const gl::Context& context = shared_context();
  const GpuTexture texture = upload(prefiltered.textures[0]);
  SamplerCache samplers;
  gl::api().BindTextureUnit(0, texture.texture->name());
  gl::api().BindSampler(0, samplers.sampler(texture.coordinates, texture.sampler_state(SamplerState::trilinear)));
  ShaderVariant variant;
  variant.footprint = filter;
  const ShaderFlags flags = shader_flags(variant, Options({}, {}, "test"), prefiltered);
  const std::string text =
      "layout(binding = 0) uniform sampler2DArray map;\n" + footprint_constants(filter) + shared_functions(flags);
  const std::string body =
      "Footprint f = Footprint(a.xy, b.xy, c.xy); int layer = " + std::to_string(layer) + ";\n" + expression;
  std::vector<glm::vec4> out = evaluate_glsl(text, body, footprints);
  context.check("looking up an array");
  return out;
}

const std::string blended = "return fetch(map, layer, f);";
const std::string summed =
    "vec4 sum = vec4(0.0); float total = 0.0;\n"
    "for (int i = 0; i < footprintTexelCount(map, f); ++i) { FootprintTexel t = footprintTexel(map, f, i); "
    "total += t.weight; sum += t.weight * fetchTexel(map, layer, t); }\n"
    "return abs(total - 1.0) < 1e-5 ? sum : vec4(9.0);";

std::vector<std::array<glm::vec4, 3>> some_footprints() {
  std::vector<std::array<glm::vec4, 3>> out;
  for (const float size : {0.001F, 0.08F, 0.3F, 0.77F, 3.0F}) {
    for (const float u : {0.03F, 0.41F, 0.98F}) {
      out.push_back(
          {glm::vec4(u, 1.0F - u * 0.7F, 0, 0), glm::vec4(size, 0.1F * size, 0, 0), glm::vec4(0, 0.3F * size, 0, 0)});
    }
  }
  return out;
}

TEST(TextureArrays, TexelsOfAFootprintSumToWhatTheSamplerBlends) {
  for (const char* const text : {"trilinear", "anisotropic:4", "box:3", "area:2", "ewa:6"}) {
    const FootprintFilter filter = parse_footprint_filter(text, "");
    for (int layer = 0; layer < 3; ++layer) {
      const auto expected =
          looked_up(three_layers(TextureFilter::trilinear), blended, layer, some_footprints(), filter);
      const auto got = looked_up(three_layers(TextureFilter::nearest), summed, layer, some_footprints(), filter);
      ASSERT_EQ(got.size(), expected.size());
      for (std::size_t i = 0; i < got.size(); ++i)
        for (int c = 0; c < 4; ++c) EXPECT_NEAR(got[i][c], expected[i][c], 2e-4F) << text << " " << layer << " " << i;
    }
  }
}

TEST(TextureArrays, LayersAreApart) {
  const Prefiltered prefiltered = three_layers(TextureFilter::trilinear);
  const std::array<std::array<glm::vec4, 3>, 1> whole{
      {{glm::vec4(0.5F), glm::vec4(8, 0, 0, 0), glm::vec4(0, 8, 0, 0)}}};
  for (int layer = 0; layer < 3; ++layer) {
    const auto top = decode_level(prefiltered.textures[0], prefiltered.textures[0].levels.size() - 1, layer).texels;
    const glm::vec4 got = looked_up(prefiltered, blended, layer, whole, {})[0];
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(got[c], top[static_cast<std::size_t>(c)], 1e-5F) << layer;
  }
}

TEST(TextureArrays, ProgramsDeclareWhatTheyNeedAndNoMore) {
  const auto text = [](const Prefiltered& prefiltered) {
    return forward_shaders({}, forward_units({}, prefiltered), {"m.glsl", ""}, Options({}, {}, "test"), prefiltered)
        .fragment.text();
  };
  const std::string with = text(three_layers(TextureFilter::nearest));
  EXPECT_NE(with.find("uniform sampler2DArray map;"), std::string::npos);
  EXPECT_NE(with.find("footprintTexel"), std::string::npos);
  const std::string without = text({});
  EXPECT_EQ(without.find("sampler2DArray"), std::string::npos);
  EXPECT_EQ(without.find("footprintTexel"), std::string::npos);
}

// Materials of the same texels have them once on the GPU; what differs in a texel, or is written by a frame build, is
// each one's own.
TEST(SharedUploads, KeepTheSameTexelsOnce) {
  const auto of = [](std::uint32_t seed, const char* name) {
    return make_texture(name, mip_chain(random_normals(8, 8, 0.9F, seed)), Storage::fp16, {});
  };
  SharedUploads uploads;
  const GpuTexture first = uploads.upload(of(1, "a"));
  const std::size_t bytes = uploads.bytes();
  EXPECT_EQ(bytes, byte_count(of(1, "a")));
  EXPECT_EQ(uploads.upload(of(1, "b")).texture, first.texture);
  EXPECT_EQ(uploads.bytes(), bytes);
  PrefilteredTexture close = of(1, "a");
  close.levels.back().bytes.back() ^= 1U;
  EXPECT_NE(uploads.upload(close).texture, first.texture);
  EXPECT_EQ(uploads.bytes(), 2 * bytes);
  const PrefilteredTexture built = make_built_texture({.name = "built", .storage = Storage::fp16, .layers = 1}, {8, 8});
  EXPECT_NE(uploads.upload(built).texture, uploads.upload(built).texture);
}

TEST(SharedUploads, AreCountedOnceInABake) {
  Scene scene = square_scene(random_normals(16, 16, 0.5F, 1), {});
  const auto bytes = [&] {
    const EffectSet set = effects_on(derive_effects(scene));
    return bake(base_surface(), {.text = "r", .name = "r", .options = {}}, scene, set, no_progress).bytes;
  };
  const std::size_t one = bytes();
  scene.materials.push_back(scene.materials.front());
  EXPECT_EQ(bytes(), one);
  scene.materials.back().normal_map =
      TextureMap{"other", std::make_shared<const Image>(random_normals(16, 16, 0.5F, 2)), {}};
  EXPECT_EQ(bytes(), 2 * one);
}

}  // namespace
}  // namespace footprint::testing
