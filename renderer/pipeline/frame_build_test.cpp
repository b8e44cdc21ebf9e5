// The hook for passes that are repeated each frame: when it runs, what it fills, and what it leaves alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "renderer/pipeline/frame.hpp"
#include "renderer/pipeline/prefiltered_file.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

constexpr std::string_view fill_pass =
    "layout(local_size_x = 1) in;\n"
    "layout(binding = 0, rgba32f) writeonly uniform image2DArray shade;\n"
    "uniform float value;\n"
    "void main() { imageStore(shade, ivec3(gl_GlobalInvocationID), vec4(value)); }\n";

// Fills a texture with the number of its run.
class Fill final : public FrameBuild {
 public:
  Fill(const ShaderVariant& variant, const Options& options, int& runs)
      : runs_(runs), pass_("fill", frame_build_shader(variant, fill_pass, "fill.glsl", options)) {}

  void run(const GpuBatch& batch, std::span<const GpuTexture> textures) const override {
    EXPECT_GT(batch.index_count, 0);
    ++runs_;
    const gl::Texture& map = textures.front().texture;
    gl::api().UseProgram(pass_.name());
    gl::api().Uniform1f(pass_.uniform("value"), static_cast<float>(runs_));
    gl::api().BindImageTexture(0, map.name(), 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA32F);
    gl::api().DispatchCompute(static_cast<GLuint>(map.width()), static_cast<GLuint>(map.height()), 1);
  }

 private:
  int& runs_;
  gl::Program pass_;
};

// Shades with what its frame build has written.
class Builder final : public Method {
 public:
  [[nodiscard]] const MethodInfo& info() const override { return info_; }
  [[nodiscard]] Prefiltered precompute(const Material& /*material*/, const Options& /*options*/,
                                       const EffectSet& /*effects*/, const Progress& /*progress*/) const override {
    return {.textures = {make_built_texture("shade", 1, 1, 1, Storage::fp32, {})}, .scalars = {}};
  }
  [[nodiscard]] std::unique_ptr<FrameBuild> frame_build(const ShaderVariant& variant,
                                                        const Options& options) const override {
    return std::make_unique<Fill>(variant, options, runs);
  }
  [[nodiscard]] std::string_view shader() const override {
    return "struct Effective { float shade; };\n"
           "Effective effective(Footprints f) { return Effective(fetch(shade, 0, f.normal).r); }\n"
           "vec3 specular(Effective e, vec3 f0, vec3 wi, vec3 wo) { return vec3(e.shade); }\n"
           "float ndf(Effective e, vec3 h) { return e.shade; }\n";
  }
  mutable int runs = 0;

 private:
  MethodInfo info_{.name = "builder",
                   .summary = {},
                   .paper = {},
                   .options = {},
                   .honours = EffectSet{}.set(static_cast<std::size_t>(Effect::point_light))};
};

GLint state_of(GLenum name) {
  GLint value = 0;
  gl::api().GetIntegerv(name, &value);
  return value;
}

TEST(FrameBuild, RunsOnceAtFirstAndOnceAFrameWhateverTheTiles) {
  const Scene scene = square_scene(constant_normals(4, 4, {0, 0, 1}), {});
  const Builder method;
  const EffectSet effects = EffectSet{}.set(static_cast<std::size_t>(Effect::point_light));
  GpuScene gpu_scene(shared_context().info(), scene, effects);
  const BakedMethod baked =
      bake(method, {.text = "builder", .name = "builder", .options = {}}, scene, effects, no_progress);
  const GpuMethod gpu(gpu_scene, baked);
  EXPECT_TRUE(gpu.builds_each_frame());
  EXPECT_EQ(method.runs, 1);
  const View view{.size = {8, 8}, .camera = scene.camera};
  const FrameRenderer frames(shared_context().info(), gpu_scene, gpu, view.size, {}, 4);  // 4 tiles
  const Image first = frames.render(view);
  EXPECT_EQ(method.runs, 2);
  const Image second = frames.render(view);
  EXPECT_EQ(method.runs, 3);
  frames.draw(view);
  EXPECT_EQ(method.runs, 4);
  shared_context().check("frame builds");
  const float one = first.at(4, 4)[0];
  EXPECT_GT(one, 0.0F);
  EXPECT_NEAR(second.at(4, 4)[0] / one, 1.5F, 1e-5F);  // what the third run has written, over what the second had
}

TEST(FrameBuild, LeavesThePipelinesStateAlone) {
  const Scene scene = square_scene(constant_normals(4, 4, {0, 0, 1}), {});
  const Builder method;
  GpuScene gpu_scene(shared_context().info(), scene, {});
  const BakedMethod baked = bake(method, {.text = "builder", .name = "builder", .options = {}}, scene, {}, no_progress);
  const GpuMethod gpu(gpu_scene, baked);
  constexpr std::array<GLenum, 1> format{GL_RGBA32F};
  const gl::RenderTarget target(5, 3, format, true);
  gl::api().BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer());
  gl::api().Viewport(0, 0, 5, 3);
  constexpr std::array<GLenum, 6> kept{
      GL_DRAW_FRAMEBUFFER_BINDING, GL_READ_FRAMEBUFFER_BINDING, GL_DEPTH_TEST, GL_CULL_FACE, GL_BLEND,
      GL_VERTEX_ARRAY_BINDING};
  std::array<GLint, kept.size()> before{};
  std::ranges::transform(kept, before.begin(), state_of);
  gpu.build_frame();
  for (std::size_t i = 0; i < kept.size(); ++i) EXPECT_EQ(state_of(kept.at(i)), before.at(i)) << i;
  std::array<GLint, 4> viewport{};
  gl::api().GetIntegerv(GL_VIEWPORT, viewport.data());
  EXPECT_EQ(viewport, (std::array<GLint, 4>{0, 0, 5, 3}));
  shared_context().check("a frame build");
}

TEST(BuiltTexture, HasSizesAndBytesButNoTexels) {
  const PrefilteredTexture texture = make_built_texture("map", 13, 6, 9, Storage::fp32, {});
  ASSERT_EQ(texture.levels.size(), 4U);
  EXPECT_EQ(texture.levels[1].width, 6);
  EXPECT_EQ(texture.levels[1].height, 3);
  EXPECT_EQ(byte_count(texture), (13U * 6U + 6U * 3U + 3U * 1U + 1U) * 9U * 16U);
  EXPECT_THROW((void)decode_level(texture, 0), std::logic_error);
  const Prefiltered prefiltered{.textures = {texture}, .scalars = {}};
  EXPECT_EQ(from_bytes(to_bytes(prefiltered)), prefiltered);
}

}  // namespace
}  // namespace footprint::testing
