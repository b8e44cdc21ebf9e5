// Benchmarks of editing small-scale geometry and of fitting mixtures.
#include <benchmark/benchmark.h>

#include <map>
#include <string>

#include "bench/benchmarks.hpp"
#include "methods/iwasaki_sg/material_table.hpp"
#include "methods/tan_gmm/mixture_chain.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/microgeometry/patch.hpp"
#include "scenes/surfaces/registry.hpp"

namespace footprint::bench {
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

void register_edit(const std::string& name, Patch patch, std::size_t facets) {
  benchmark::RegisterBenchmark(
      ("iwasaki_sg/edit/" + name).c_str(),
      [patch = std::move(patch), facets](benchmark::State& state) { edit(state, patch, facets); })
      ->UseRealTime()
      ->MeasureProcessCPUTime()
      ->Unit(benchmark::kMillisecond);
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
