// The bare frame, a yardstick for frame times: the least that shades the triangles of Khronos' ClearCoatTest, or of
// another scene, from a normal map under a light.
#include <benchmark/benchmark.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <glm/gtc/type_ptr.hpp>
#include <memory>
#include <string>
#include <vector>

#include "app/folders.hpp"
#include "bench/benchmarks.hpp"
#include "experiments/studies/stage.hpp"
#include "renderer/bake/material_maps.hpp"
#include "renderer/core/embedded_texts.hpp"
#include "renderer/pipeline/frame.hpp"
#include "renderer/scene/assembly/load_scene.hpp"

namespace footprint {

extern const EmbeddedTexts bench_glsl;

namespace bench {
namespace {

// One fetch of the normal map at its finest level and one GGX lobe under one light, by a program that knows nothing of
// effects, footprints, materials or light lists. Draws the batches of a GpuScene into 32-bit floats with depth.
class BareFrame {
 public:
  BareFrame(const Scene& scene, const GpuScene& gpu_scene, const glm::ivec2& size)
      : gpu_scene_(&gpu_scene),
        sampler_(gl::trilinear_sampler(GL_REPEAT, GL_REPEAT)),
        program_("bare", find_text(bench_glsl, "bare_vertex.glsl")->text,
                 find_text(bench_glsl, "bare_fragment.glsl")->text),
        target_(size.x, size.y, std::array<GLenum, 1>{GL_RGBA32F}, true) {
    for (const GpuBatch& batch : gpu_scene.batches()) {
      const Material& material = scene.materials.at(batch.material);
      normal_maps_.push_back(upload(
          make_level_texture("normal_map", normal_map_of(material), Storage::fp32, normal_coordinates(material))));
    }
    const glm::vec3 to_light = glm::normalize(glm::vec3(0.3F, 0.5F, 1.0F));
    gl::api().ProgramUniform3fv(program_.name(), program_.uniform("to_light"), 1, glm::value_ptr(to_light));
  }

  /// Draws a view of a perspective camera; the pixels stay on the GPU.
  void draw(const View& view) const {
    const glm::mat4 world_to_clip = tile_matrix(view, {.origin = {0, 0}, .size = view.size}, {0.0, 0.0});
    const glm::vec3 camera = camera_position(view.camera);
    gl::api().BindFramebuffer(GL_FRAMEBUFFER, target_.framebuffer());
    gl::api().Viewport(0, 0, view.size.x, view.size.y);
    clear_target();
    gl::api().UseProgram(program_.name());
    gl::api().UniformMatrix4fv(program_.uniform("world_to_clip"), 1, GL_FALSE, glm::value_ptr(world_to_clip));
    gl::api().Uniform3fv(program_.uniform("camera_position"), 1, glm::value_ptr(camera));
    gl::api().Enable(GL_DEPTH_TEST);
    gl::api().DepthFunc(GL_GREATER);
    gl::api().BindSampler(0, sampler_.name());
    for (std::size_t i = 0; i < normal_maps_.size(); ++i) {
      const GpuBatch& batch = gpu_scene_->batches()[i];
      if (batch.double_sided) {
        gl::api().Disable(GL_CULL_FACE);
      } else {
        gl::api().Enable(GL_CULL_FACE);
      }
      gl::api().BindTextureUnit(0, normal_maps_[i].texture->name());
      gl::api().BindVertexArray(batch.vertex_array.name());
      gl::api().DrawElements(GL_TRIANGLES, batch.index_count, GL_UNSIGNED_INT, nullptr);
    }
  }

 private:
  const GpuScene* gpu_scene_;
  std::vector<GpuTexture> normal_maps_;  // one per batch
  gl::Sampler sampler_;
  gl::Program program_;
  gl::RenderTarget target_;
};

// The scene at the camera's own distance.
struct BareScene {
  explicit BareScene(Scene scene)
      : stage(std::move(scene), bench_settings("direct"), no_progress),
        view(stage.view(1.0)),
        frame(stage.scene(), stage.gpu_scene(), view.size) {
    stage.context().check("setting up the benchmark");
  }

  Stage stage;
  View view;
  BareFrame frame;
};

void draw_frames(benchmark::State& state, const BareScene& scene) {
  gl::FrameTimer timer(scene.stage.context().info());
  scene.frame.draw(scene.view);  // shaders are compiled when they are first drawn with
  for ([[maybe_unused]] auto _ : state) {
    timer.begin();
    scene.frame.draw(scene.view);
    state.SetIterationTime(1e-3 * timer.end_ms());
  }
}

}  // namespace

std::optional<Scene> load_bench_scene(const std::string& name) {
  const SceneLibrary library = scene_library();
  if (!name.empty()) return load_scene(name, library);
  if (!std::filesystem::exists(FOOTPRINT_BENCH_MODEL)) {
    (void)std::fprintf(stderr, "footprint_bench: no frames are timed: %s is not there (install assimp-testmodels)\n",
                       FOOTPRINT_BENCH_MODEL);
    return {};
  }
  Scene scene = load_scene(FOOTPRINT_BENCH_MODEL, library);
  scene.environment.reset();
  scene.horizon = Horizon::cut;
  scene.shadows.cast = false;  // the bare shader has none
  for (Material& material : scene.materials) material.coat.reset();
  return scene;
}

void register_frame_benchmark(Scene scene) {
  const auto subject = std::make_shared<const BareScene>(std::move(scene));
  benchmark::RegisterBenchmark("frame/bare", [subject](benchmark::State& state) { draw_frames(state, *subject); })
      ->UseManualTime()
      ->MeasureProcessCPUTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace bench
}  // namespace footprint
