// Loads the scene to time and picks its methods: those named, else all that bake fast; `direct` always.
#include "bench/bench_scene.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>

#include "app/folders.hpp"
#include "methods/registry.hpp"
#include "renderer/core/disk_cache.hpp"
#include "renderer/core/error.hpp"
#include "renderer/scene/assembly/load_scene.hpp"

namespace footprint::bench {

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
    scene.shadows.cast = false;  // the bare shader has none: docs/performance.md gives their cost separately
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
    const MethodInfo& info = method->info();
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

}  // namespace footprint::bench
