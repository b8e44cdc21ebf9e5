// footprint_bench: what frames, the reference, start-up, mip chains, mixtures, edits of small-scale geometry and baking
// cost (docs/performance.md).
#include <benchmark/benchmark.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <optional>
#include <string>

#include "bench/frame_benchmarks.hpp"
#include "bench/frame_builds.hpp"
#include "bench/iwasaki_benchmarks.hpp"
#include "bench/mip_benchmarks.hpp"
#include "bench/ratios.hpp"
#include "bench/tan_gmm_benchmarks.hpp"
#include "renderer/core/error.hpp"

namespace {

void run(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);  // takes the --benchmark_... options out
  CLI::App app("Benchmarks of Footprint; all --benchmark_... options of Google Benchmark work too.", "footprint_bench");
  int repeats = 0;
  app.add_option("--ratios", repeats, "Print ratios of interleaved frame times over this many rounds, and nothing else")
      ->check(CLI::Range(1, 100000));
  int build_repeats = 0;
  app.add_option("--builds", build_repeats,
                 "Print what frame builds of --methods cost by the size of the map, over this many rounds")
      ->check(CLI::Range(1, 100000));
  std::string scene_name;
  app.add_option("--scene", scene_name, "What to draw: as `footprint compare` takes it; if not given, ClearCoatTest");
  std::string methods;
  app.add_option("--methods", methods, "Methods to draw by; if not given, all whose precompute takes no seconds");
  std::string over = "direct";
  app.add_option("--over", over, "The method that --ratios takes every other to")->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error));
  }
  if (build_repeats > 0) {
    if (methods.empty()) methods = "xu_vmf:rebuild=changed";
    (void)std::fputs(footprint::bench::frame_build_table(methods, build_repeats).c_str(), stdout);
    return;
  }
  std::optional<footprint::Scene> scene = footprint::bench::load_bench_scene(scene_name);
  std::optional<footprint::bench::BenchScene> subject;
  if (scene) subject.emplace(std::move(*scene), footprint::bench::bench_settings(methods));
  if (repeats > 0) {
    if (subject) (void)std::fputs(footprint::bench::ratio_table(*subject, over, repeats).c_str(), stdout);
    return;
  }
  if (subject) {
    footprint::bench::register_frame_benchmarks(*subject);
    footprint::bench::register_start_up_benchmarks(*subject);
  }
  footprint::bench::register_mip_benchmarks();
  footprint::bench::register_tan_gmm_benchmarks();
  footprint::bench::register_iwasaki_benchmarks();
  benchmark::RunSpecifiedBenchmarks();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(argc, argv);
    return 0;
  } catch (const footprint::Error& error) {
    (void)std::fprintf(stderr, "footprint_bench: %s\n", error.what());
    return static_cast<int>(error.kind());
  } catch (const std::exception& error) {
    (void)std::fprintf(stderr, "footprint_bench: %s\n", error.what());
    return static_cast<int>(footprint::ErrorKind::machine);
  }
}
