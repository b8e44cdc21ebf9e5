// Benchmarks of building mip chains, also off powers of two.
#include "bench/mip_benchmarks.hpp"

#include <benchmark/benchmark.h>

#include "renderer/image/mipmap.hpp"

namespace footprint::bench {
namespace {

void build_chain(benchmark::State& state) {
  const Image finest(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)), 4, 0.5F);
  for ([[maybe_unused]] auto _ : state) {
    state.PauseTiming();
    Image copy = finest;
    state.ResumeTiming();
    benchmark::DoNotOptimize(mip_chain(std::move(copy)));
  }
  state.SetItemsProcessed(state.iterations() * state.range(0) * state.range(1));
}

}  // namespace

void register_mip_benchmarks() {
  benchmark::RegisterBenchmark("mip_chain/rgba", build_chain)
      ->Args({1024, 1024})
      ->Args({4096, 4096})
      ->Args({1000, 777})
      ->UseRealTime()
      ->MeasureProcessCPUTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace footprint::bench
