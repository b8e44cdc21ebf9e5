// See bench_scene.hpp.
#include "bench/bench_scene.hpp"

#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "methods/registry.hpp"
#include "renderer/scene/load_scene.hpp"

namespace footprint::bench {

std::optional<Scene> load_bench_scene() {
  if (std::filesystem::exists(FOOTPRINT_BENCH_MODEL)) return load_scene(FOOTPRINT_BENCH_MODEL, {});
  (void)std::fprintf(stderr, "footprint_bench: no frames are timed: %s is not there (install assimp-testmodels)\n",
                     FOOTPRINT_BENCH_MODEL);
  return {};
}

StageSettings bench_settings() {
  StageSettings settings{.methods = {}, .size = frame_pixels};
  for (const Method* method : all_methods()) {
    settings.methods.push_back({.text = method->info().name, .name = method->info().name, .options = {}});
  }
  return settings;
}

BenchScene::BenchScene(Scene scene)
    : stage_(gl::ContextRequest{}, std::move(scene), bench_settings(), no_progress),
      view_(stage_.view(1.0)),
      bare_(stage_.scene(), stage_.gpu_scene(), view_.size) {
  stage_.context().check("setting up the benchmark");
}

void BenchScene::draw_reference() const { stage_.reference().draw(view_, reference_spp, reference_seed); }

const StagedMethod& BenchScene::method(std::string_view name) const {
  for (const StagedMethod& method : stage_.methods()) {
    if (method.baked().spec.name == name) return method;
  }
  throw std::logic_error("no such method: " + std::string(name));
}

}  // namespace footprint::bench
