// Frames are timed as in reports: on a software renderer wall clock around glFinish.
#include "bench/benchmarks.hpp"

#include <benchmark/benchmark.h>

#include <functional>

#include "renderer/gl/functions.hpp"
#include "renderer/gl/objects.hpp"
#include "renderer/pipeline/timing.hpp"

namespace footprint::bench {
namespace {

constexpr double seconds_per_ms = 1e-3;

void add_drawing(const std::string& name, const gl::ContextInfo& context, const DrawFrame& draw) {
  const auto run = [&context, draw](benchmark::State& state) {
    gl::FrameTimer timer(context);
    draw();  // shaders are compiled when they are first drawn with
    for ([[maybe_unused]] auto _ : state) {
      timer.begin();
      draw();
      state.SetIterationTime(timer.end_ms() * seconds_per_ms);
    }
  };
  benchmark::RegisterBenchmark(name.c_str(), run)
      ->UseManualTime()
      ->MeasureProcessCPUTime()
      ->Unit(benchmark::kMillisecond);
}

void add_work(const std::string& name, const std::function<void()>& work) {
  const auto run = [work](benchmark::State& state) {
    for ([[maybe_unused]] auto _ : state) work();
  };
  benchmark::RegisterBenchmark(name.c_str(), run)
      ->UseRealTime()
      ->MeasureProcessCPUTime()
      ->Unit(benchmark::kMillisecond);
}

// From nothing to a first frame of `direct`, all of it waited for.
void start_up() {
  RunSettings settings;
  settings.methods = parse_methods("direct");
  settings.view.size = frame_pixels;
  const Stage stage(load_bench_model(), settings, no_progress);
  stage.methods().front().frames().draw(stage.view(1.0));
  gl::api().Finish();
}

}  // namespace

void register_frame_benchmarks(const BenchScene& scene) {
  const gl::ContextInfo& context = scene.stage().context().info();
  add_drawing("frame/bare", context, [&scene] { scene.draw_bare(); });
  for (const StagedMethod& method : scene.stage().methods()) {
    const std::string& name = method.baked().spec.name;
    add_drawing("frame/" + name, context, [&scene, &method] { scene.draw(method); });
    add_work("bake/" + name, [&scene, &method] {
      const BakedMethod& baked = method.baked();
      benchmark::DoNotOptimize(
          bake(*baked.method, baked.spec, scene.stage().scene(), scene.stage().effects(), no_progress));
    });
  }
  const StagedMethod& direct = scene.method("direct");
  add_drawing("64_frames/direct", context, [&scene, &direct] {
    for (int i = 0; i < reference_spp; ++i) scene.draw(direct);
  });
  add_drawing("reference_64/draw", context, [&scene] { scene.draw_reference(); });
  add_work("reference_64/render", [&scene] {
    benchmark::DoNotOptimize(
        scene.stage().reference().render(scene.view(), reference_spp, reference_seed, no_progress));
  });
}

void register_start_up_benchmarks(const BenchScene& scene) {
  const auto then_back = [&scene](const std::function<void()>& work) {
    return [&scene, work] {
      work();
      scene.stage().context().make_current();
    };
  };
  add_work("start_up/context", then_back([] { const gl::Context context(gl::ContextRequest{}); }));
  add_work("start_up/load_scene", [] { benchmark::DoNotOptimize(load_bench_model()); });
  add_work("start_up/to_first_frame", then_back(start_up));
}

}  // namespace footprint::bench
