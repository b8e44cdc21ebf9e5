// The hook for passes that are repeated each frame: when it runs, what it fills, and what it leaves alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "renderer/bake/baked_method.hpp"
#include "renderer/core/error.hpp"
#include "renderer/pipeline/base_surface.hpp"
#include "renderer/pipeline/frame.hpp"
#include "renderer/pipeline/surface_program.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

constexpr std::string_view fill_pass =
    "layout(local_size_x = 1) in;\n"
    "layout(binding = 0, rgba32f) writeonly uniform image2DArray shade;\n"
    "uniform float value;\n"
    "void main() { imageStore(shade, ivec3(gl_GlobalInvocationID), vec4(value)); }\n";

// Fills a texture with the number of its run, and changes all GL state that it may.
class Fill final : public FrameBuild {
 public:
  Fill(const ShaderVariant& variant, const Options& options, int& runs, std::optional<BuildInputs> inputs)
      : runs_(runs),
        inputs_(inputs),
        pass_("fill", frame_build_shader(variant, {"fill.glsl", fill_pass}, options).text()) {}

  [[nodiscard]] std::optional<BuildInputs> valid_until_change_of() const override { return inputs_; }

  void run(const FrameBuildJob& job) const override {
    EXPECT_GT(job.batch.index_count, 0);
    EXPECT_EQ(job.vertex_array, job.batch.vertex_array.name());
    ++runs_;
    gl::api().BindFramebuffer(GL_FRAMEBUFFER, 0);
    gl::api().Viewport(1, 1, 1, 1);
    gl::api().BindVertexArray(job.vertex_array);
    for (const GLenum name : {GL_DEPTH_TEST, GL_CULL_FACE, GL_BLEND}) gl::api().Enable(name);
    const gl::Texture& map = *job.textures.front().texture;
    gl::api().UseProgram(pass_.name());
    gl::api().Uniform1f(pass_.uniform("value"), static_cast<float>(runs_));
    gl::api().BindImageTexture(0, map.name(), 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA32F);
    gl::api().DispatchCompute(static_cast<GLuint>(map.width()), static_cast<GLuint>(map.height()), 1);
  }

 private:
  int& runs_;
  std::optional<BuildInputs> inputs_;
  gl::Program pass_;
};

// Shades with what its frame build has written.
struct Builder {
  int runs = 0;
  std::optional<BuildInputs> inputs{};
  Method method{
      .info = {.name = "builder",
               .summary = {},
               .paper = {},
               .options = {},
               .honours = EffectSet{}.set(static_cast<std::size_t>(Effect::point_light))},
      .precompute =
          [](const Material& /*material*/, const Options& /*options*/, const EffectSet& /*effects*/,
             const Progress& /*progress*/) {
            return Prefiltered{.textures = {make_built_texture({.name = "filled", .layers = 1}, {1, 1})},
                               .scalars = {}};
          },
      .shader = {"builder.glsl",
                 "struct Effective { float shade; };\n"
                 "Effective effective(Footprints f) { return Effective(fetch(filled, 0, f.normal).r); }\n"
                 "Reflected shade(Effective e, Surface s, vec3 wi, vec3 wo) { return Reflected(vec3(e.shade)); }\n"
                 "float ndf(Effective e, vec3 h) { return e.shade; }\n"},
      .frame_build = [this](const ShaderVariant& variant, const Options& options) -> std::unique_ptr<FrameBuild> {
        return std::make_unique<Fill>(variant, options, runs, inputs);
      }};
};

GLint state_of(GLenum name) {
  GLint value = 0;
  gl::api().GetIntegerv(name, &value);
  return value;
}

TEST(FrameBuild, RunsOncePerFrameForAnyTiles) {
  const Scene scene = square_scene(constant_normals(4, 4, {0, 0, 1}), {});
  Builder builder;
  const EffectSet effects = EffectSet{}.set(static_cast<std::size_t>(Effect::point_light));
  GpuScene gpu_scene(shared_context().info(), scene, effects);
  const BakedMethod baked =
      bake(builder.method, {.text = "builder", .name = "builder", .options = {}}, scene, effects, no_progress);
  const GpuMethod gpu(gpu_scene, baked);
  EXPECT_TRUE(gpu.has_frame_build());
  EXPECT_FALSE(gpu.reuses_build());
  EXPECT_EQ(builder.runs, 0);
  const View view{.size = {8, 8}, .camera = scene.camera};
  const FrameRenderer frames(shared_context().info(), gpu_scene, gpu, view.size, {}, 4);  // 4 tiles
  const Image first = frames.render(view);
  EXPECT_EQ(builder.runs, 1);
  const Image second = frames.render(view);
  EXPECT_EQ(builder.runs, 2);
  frames.draw(view);
  EXPECT_EQ(builder.runs, 3);
  shared_context().check("frame builds");
  const float one = first.at(4, 4)[0];
  EXPECT_GT(one, 0.0F);
  EXPECT_NEAR(second.at(4, 4)[0] / one, 2.0F, 1e-5F);  // what the second run has written, over what the first had
}

TEST(FrameBuild, LeavesThePipelinesStateAlone) {
  const Scene scene = square_scene(constant_normals(4, 4, {0, 0, 1}), {});
  Builder builder;
  GpuScene gpu_scene(shared_context().info(), scene, {});
  const BakedMethod baked =
      bake(builder.method, {.text = "builder", .name = "builder", .options = {}}, scene, {}, no_progress);
  const GpuMethod gpu(gpu_scene, baked);
  constexpr std::array<GLenum, 1> format{GL_RGBA32F};
  const gl::RenderTarget target(5, 3, format, true);
  gl::api().BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer());
  gl::api().Viewport(0, 0, 5, 3);
  constexpr std::array<GLenum, 6> states{
      GL_DRAW_FRAMEBUFFER_BINDING, GL_READ_FRAMEBUFFER_BINDING, GL_DEPTH_TEST, GL_CULL_FACE, GL_BLEND,
      GL_VERTEX_ARRAY_BINDING};
  std::array<GLint, states.size()> before{};
  std::ranges::transform(states, before.begin(), state_of);
  gpu.build_frame({.size = {5, 3}, .camera = scene.camera});
  for (std::size_t i = 0; i < states.size(); ++i) EXPECT_EQ(state_of(states.at(i)), before.at(i)) << i;
  std::array<GLint, 4> viewport{};
  gl::api().GetIntegerv(GL_VIEWPORT, viewport.data());
  EXPECT_EQ(viewport, (std::array<GLint, 4>{0, 0, 5, 3}));
  shared_context().check("a frame build");
}

// One frame after the other of a scene that changes, by a build that depends on `inputs`: how often it ran.
std::vector<int> runs_over(const std::vector<Scene>& frames, const BuildInputs& inputs) {
  Builder builder;
  builder.inputs = inputs;
  const EffectSet effects = EffectSet{}.set(static_cast<std::size_t>(Effect::point_light));
  GpuScene gpu_scene(shared_context().info(), frames.front(), effects);
  const BakedMethod baked =
      bake(builder.method, {.text = "builder", .name = "builder", .options = {}}, frames.front(), effects, no_progress);
  const GpuMethod gpu(gpu_scene, baked);
  EXPECT_TRUE(gpu.reuses_build());
  std::vector<int> runs;
  for (const Scene& frame : frames) {
    gpu_scene.update(frame);
    gpu.build_frame({.size = {4, 4}, .camera = frame.camera});
    runs.push_back(builder.runs);
  }
  return runs;
}

TEST(FrameBuild, IsReusedUntilOneOfItsInputsChanges) {
  const Scene still = square_scene(constant_normals(4, 4, {0, 0, 1}), {});
  std::vector<Scene> frames(6, still);
  for (std::size_t i = 2; i < frames.size(); ++i) frames[i].camera.world[3].x = 0.1F;
  for (std::size_t i = 3; i < frames.size(); ++i) frames[i].meshes[0].vertices[1].position.z = 0.1F;
  for (std::size_t i = 4; i < frames.size(); ++i) frames[i].materials[0].roughness = 0.7F;
  for (std::size_t i = 5; i < frames.size(); ++i) std::get<PointLight>(frames[i].lights[0]).position.x = 1.0F;
  EXPECT_EQ(runs_over(frames, {.camera = true}), (std::vector<int>{1, 1, 2, 2, 2, 2}));
  EXPECT_EQ(runs_over(frames, {.geometry = true}), (std::vector<int>{1, 1, 1, 2, 2, 2}));
  EXPECT_EQ(runs_over(frames, {.materials = true}), (std::vector<int>{1, 1, 1, 1, 2, 2}));
  EXPECT_EQ(runs_over(frames, {.lights = true}), (std::vector<int>{1, 1, 1, 1, 1, 2}));
}

TEST(GpuSceneUpdate, DrawsWhatAFreshSceneDraws) {
  const Scene before = square_scene(random_normals(8, 8, 0.4F, 1), {});
  Scene after = before;
  for (Vertex& vertex : after.meshes[0].vertices) vertex.position.z += 0.2F * vertex.position.x;
  after.materials[0].roughness = 0.3F;
  std::get<PointLight>(after.lights[0]).position = {-0.5F, 0.2F, 1.0F};
  TestRenderer fresh(after), updated(before);
  updated.update(after);
  EXPECT_EQ(updated.frame(base_surface()), fresh.frame(base_surface()));
  EXPECT_NE(updated.frame(base_surface()), TestRenderer(before).frame(base_surface()));
}

TEST(GpuSceneUpdate, RefusesAnotherScene) {
  const Scene scene = square_scene({}, {});
  GpuScene gpu_scene(shared_context().info(), scene, {});
  Scene more_vertices = scene, more_lights = scene, no_material = scene;
  more_vertices.meshes[0].vertices.emplace_back();
  more_lights.lights.push_back(scene.lights[0]);
  no_material.materials.clear();
  for (const Scene& other : {more_vertices, more_lights, no_material}) EXPECT_THROW(gpu_scene.update(other), Error);
  EXPECT_NO_THROW(gpu_scene.update(scene));
}

TEST(BuiltTexture, HasSizesAndBytesButNoTexels) {
  const PrefilteredTexture texture = make_built_texture({.name = "map", .layers = 9}, {13, 6});
  ASSERT_EQ(texture.levels.size(), 4U);
  EXPECT_EQ(texture.levels[1].width, 6);
  EXPECT_EQ(texture.levels[1].height, 3);
  EXPECT_EQ(byte_count(texture), (13U * 6U + 6U * 3U + 3U * 1U + 1U) * 9U * 16U);
  EXPECT_THROW((void)decode_level(texture, 0), std::logic_error);
  EXPECT_EQ(make_built_texture({.name = "map", .layers = 1}, {13, 6}, false).levels.size(), 1U);
  Prefiltered prefiltered{.textures = {texture}, .scalars = {}};
  const auto from_disk = [](const Prefiltered& written) {
    std::vector<std::uint8_t> bytes;
    write_bytes(written, appending_to(bytes));
    return from_bytes(bytes);
  };
  EXPECT_EQ(from_disk(prefiltered), prefiltered);
  prefiltered.surface_coordinates = {{0.25F, 1.0F}, {0.0F, 0.5F}};
  EXPECT_EQ(from_disk(prefiltered), prefiltered);
}

}  // namespace
}  // namespace footprint::testing
