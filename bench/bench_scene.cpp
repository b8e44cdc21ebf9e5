// Loads the scene to time and picks its methods: those named, else all that bake fast; `direct` always. The yardstick
// draws each batch with its normal map under one fixed direction of light, into 32-bit floats with depth.
#include "bench/bench_scene.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <glm/gtc/type_ptr.hpp>
#include <string>

#include "app/folders.hpp"
#include "methods/registry.hpp"
#include "renderer/bake/material_maps.hpp"
#include "renderer/core/disk_cache.hpp"
#include "renderer/core/embedded_texts.hpp"
#include "renderer/core/error.hpp"
#include "renderer/pipeline/frame.hpp"
#include "renderer/scene/assembly/load_scene.hpp"

namespace footprint {

extern const EmbeddedTexts bench_glsl;

namespace bench {

BareFrame::BareFrame(const Scene& scene, const GpuScene& gpu_scene, const glm::ivec2& size)
    : gpu_scene_(&gpu_scene),
      sampler_(gl::trilinear_sampler(GL_REPEAT, GL_REPEAT)),
      program_("bare", find_text(bench_glsl, "bare_vertex.glsl")->text,
               find_text(bench_glsl, "bare_fragment.glsl")->text),
      target_(size.x, size.y, std::array<GLenum, 1>{GL_RGBA32F}, true) {
  for (const GpuBatch& batch : gpu_scene.batches()) {
    const Material& material = scene.materials.at(batch.material);
    normal_maps_.push_back(
        upload(make_level_texture("normal_map", normal_map_of(material), Storage::fp32, normal_coordinates(material))));
  }
  const glm::vec3 to_light = glm::normalize(glm::vec3(0.3F, 0.5F, 1.0F));
  gl::api().ProgramUniform3fv(program_.name(), program_.uniform("to_light"), 1, glm::value_ptr(to_light));
}

void BareFrame::draw(const View& view) const {
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

Scene load_bench_model() {
  Scene scene = load_scene(FOOTPRINT_BENCH_MODEL, scene_library());
  scene.environment.reset();
  scene.horizon = Horizon::cut;
  for (Material& material : scene.materials) material.coat.reset();
  return scene;
}

std::optional<Scene> load_bench_scene(const std::string& name) {
  const SceneLibrary library = scene_library();
  if (!name.empty()) return load_scene(name, library);
  if (std::filesystem::exists(FOOTPRINT_BENCH_MODEL)) {
    Scene scene = load_bench_model();
    scene.shadows.cast = false;  // the bare shader has none: performance.md gives their cost separately
    return scene;
  }
  (void)std::fprintf(stderr, "footprint_bench: no frames are timed: %s is not there (install assimp-testmodels)\n",
                     FOOTPRINT_BENCH_MODEL);
  return {};
}

RunSettings bench_settings(const std::string& methods) {
  RunSettings settings;
  settings.view.size = frame_pixels;
  settings.cache = default_cache_folder();
  if (!methods.empty()) settings.methods = parse_methods(methods);
  for (const Method* method : all_methods()) {
    const MethodInfo& info = method->info;
    if (methods.empty() && !info.slow_precompute)
      settings.methods.push_back({.text = info.name, .name = info.name, .options = {}});
  }
  if (std::ranges::find(settings.methods, "direct", &MethodSpec::text) == settings.methods.end())
    settings.methods.insert(settings.methods.begin(), {.text = "direct", .name = "direct", .options = {}});
  return settings;
}

BenchScene::BenchScene(Scene scene, const RunSettings& settings)
    : stage_(std::move(scene), settings, no_progress),
      view_(stage_.view(1.0)),
      bare_(stage_.scene(), stage_.gpu_scene(), view_.size) {
  stage_.context().check("setting up the benchmark");
}

void BenchScene::draw_reference() const { stage_.reference().draw(view_, reference_spp, reference_seed); }

const StagedMethod& BenchScene::method(const std::string& text) const {
  for (const StagedMethod& method : stage_.methods()) {
    if (method.baked().spec.text == text) return method;
  }
  throw Error(ErrorKind::usage, "--over", "`" + text + "` is none of the methods that are drawn",
              "add it to --methods");
}

}  // namespace bench
}  // namespace footprint
