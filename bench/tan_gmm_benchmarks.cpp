// Benchmarks of fitting Tan's mixtures.
#include "bench/tan_gmm_benchmarks.hpp"

#include <benchmark/benchmark.h>

#include "methods/tan_gmm/mixture_chain.hpp"
#include "scenes/surfaces/registry.hpp"

namespace footprint::bench {
namespace {

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

}  // namespace

void register_tan_gmm_benchmarks() {
  for (const Surface& surface : all_surfaces()) {
    for (const bool align : {true, false}) {
      const std::string name = "tan_gmm/" + surface.name + (align ? "/aligned" : "/unaligned");
      benchmark::RegisterBenchmark(
          name.c_str(), [&surface, align](benchmark::State& state) { fit_all_levels(state, surface, align); })
          ->Arg(512)
          ->UseRealTime()
          ->MeasureProcessCPUTime()
          ->Unit(benchmark::kMillisecond);
    }
  }
}

}  // namespace footprint::bench
