// Benchmarks of editing small-scale geometry, of fitting mixtures, and of the bare frame, a yardstick for frame times:
// the least that shades the triangles of Khronos' ClearCoatTest, or of another scene, from a normal map under a light.
#include "bench/benchmarks.hpp"

#include <benchmark/benchmark.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/folders.hpp"
#include "experiments/studies/stage.hpp"
#include "methods/iwasaki_sg/material_table.hpp"
#include "methods/tan_gmm/mixture_chain.hpp"
#include "renderer/bake/material_maps.hpp"
#include "renderer/core/embedded_texts.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/microgeometry/patch.hpp"
#include "renderer/pipeline/frame.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "scenes/surfaces/registry.hpp"

namespace footprint {

extern const EmbeddedTexts bench_glsl;

namespace bench {
namespace {

// All stages of an edit; each stage's milliseconds as a counter.
void edit(benchmark::State& state, const Patch& patch, std::size_t facets) {
  iwasaki_sg::TableSettings settings;
  settings.facets = facets;
  settings.paints.resize(patch.palette.size());
  std::map<std::string, double> milliseconds;
  std::size_t normals = 0;
  for ([[maybe_unused]] auto _ : state) {
    StageClock clock;
    const auto table = iwasaki_sg::patch_table(patch, settings, clock.callback(no_progress));
    clock.stop();
    for (const StageTime& time : clock.times()) milliseconds[time.stage] += 1e3 * time.seconds;
    normals = table.normals;
  }
  for (const auto& [stage, sum] : milliseconds) {
    state.counters[stage] = benchmark::Counter(sum, benchmark::Counter::kAvgIterations);
  }
  state.counters["normals"] = static_cast<double>(normals);
  state.counters["triangles"] = static_cast<double>(patch.triangles.size());
}

// With CPU times, in milliseconds.
benchmark::internal::Benchmark* add(const std::string& name, const auto& run) {
  return benchmark::RegisterBenchmark(name.c_str(), run)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);
}

void register_edit(const std::string& name, Patch patch, std::size_t facets) {
  add("iwasaki_sg/edit/" + name, [patch = std::move(patch), facets](benchmark::State& state) {
    edit(state, patch, facets);
  })->UseRealTime();
}

void fit_all_levels(benchmark::State& state, const Surface& surface, bool align) {
  SurfaceSettings map = surface_settings(surface, {});
  map.resolution = static_cast<int>(state.range(0));
  const tan_gmm::NormalField normals(surface_normals(surface, map));
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(
        tan_gmm::mixture_chain(normals, {.align = align}, tan_gmm::Moment::corrected, no_progress));
  }
  state.SetItemsProcessed(state.iterations() * state.range(0) * state.range(0));
}

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
      batch.double_sided ? gl::api().Disable(GL_CULL_FACE) : gl::api().Enable(GL_CULL_FACE);
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

void register_iwasaki_benchmarks() {
  constexpr std::size_t paper_facets = 65536;
  for (const PatchKind& kind : patch_kinds()) register_edit(kind.name, make_patch(kind, {}), paper_facets);
  const PatchKind& weave = find_patch_kind("weave");
  for (const std::size_t facets : {std::size_t{16384}, std::size_t{262144}}) {
    register_edit("weave/facets:" + std::to_string(facets), make_patch(weave, {}), facets);
  }
  const PatchKind& noise = find_patch_kind("noise");
  for (const char* steps : {"12", "24", "96"}) {
    register_edit(std::string("noise/steps:") + steps, make_patch(noise, {{"steps", steps}}), paper_facets);
  }
}

void register_tan_gmm_benchmarks() {
  for (const Surface& surface : all_surfaces()) {
    for (const bool align : {true, false}) {
      add("tan_gmm/" + surface.name + (align ? "/aligned" : "/unaligned"),
          [&surface, align](benchmark::State& state) { fit_all_levels(state, surface, align); })
          ->Arg(512)
          ->UseRealTime();
    }
  }
}

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
  add("frame/bare", [subject](benchmark::State& state) { draw_frames(state, *subject); })->UseManualTime();
}

}  // namespace bench
}  // namespace footprint
