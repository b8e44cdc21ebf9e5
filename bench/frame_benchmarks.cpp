// The frame of the bare shader, timed as in reports: on a software renderer wall clock around glFinish.
#include "bench/benchmarks.hpp"

#include <benchmark/benchmark.h>

#include "renderer/gl/objects.hpp"

namespace footprint::bench {

void register_frame_benchmark(const BenchScene& scene) {
  const auto run = [&scene](benchmark::State& state) {
    gl::FrameTimer timer(scene.stage().context().info());
    scene.draw_bare();  // shaders are compiled when they are first drawn with
    for ([[maybe_unused]] auto _ : state) {
      timer.begin();
      scene.draw_bare();
      state.SetIterationTime(1e-3 * timer.end_ms());
    }
  };
  benchmark::RegisterBenchmark("frame/bare", run)
      ->UseManualTime()
      ->MeasureProcessCPUTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace footprint::bench
