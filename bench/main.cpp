// footprint_bench: the time of the bare frame, mixtures, edits of small-scale geometry, bakes and sizes of footprints
// (docs/contributing/performance.md).
#include <benchmark/benchmark.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <optional>
#include <string>

#include "bench/benchmarks.hpp"
#include "renderer/core/error.hpp"

namespace {

// The values of the command line.
struct Request {
  int footprint_rounds = 0, bake_rounds = 0;  // 0: not that mode
  footprint::bench::BakeLimits bake_limits;
  int resolution = 4096;  // of the map under the footprints
  double most_ratio = 0.0;
  std::string scene, methods = "atanasov_bins:roughness=bin";
};

constexpr const char* examples = R"(
Examples:
  footprint_bench
  footprint_bench --benchmark_filter=tan_gmm
  footprint_bench --footprints 5 --methods atanasov_bins:roughness=bin,tan_gmm --resolution 1024
  footprint_bench --bakes 3 --scene scratched_metal --methods atanasov_bins:m=63:roughness=bin --most-seconds 10
)";

void declare_options(CLI::App& app, Request& request) {
  const CLI::Range rounds(1, 100000);
  app.add_option("--footprints", request.footprint_rounds,
                 "Print what frames of --methods cost by the size of a pixel's footprint, over this many rounds")
      ->check(rounds);
  app.add_option(
         "--most-ratio", request.most_ratio,
         "With --footprints: what the most expensive footprint of a method may take over the median of all, else the "
         "exit code is 1")
      ->check(CLI::PositiveNumber);
  app.add_option(
         "--bakes", request.bake_rounds,
         "Print what baking --methods takes on --scene, the quickest of this many rounds; exit code 1 where it is "
         "more than one of the next two options")
      ->check(rounds);
  app.add_option("--most-seconds", request.bake_limits.seconds, "With --bakes: wall clock that a bake may take")
      ->check(CLI::PositiveNumber);
  app.add_option("--most-gigabytes", request.bake_limits.gigabytes,
                 "With --bakes: 1e9 bytes of memory that the process may take")
      ->check(CLI::PositiveNumber);
  app.add_option("--resolution", request.resolution, "With --footprints: texels per side of the map")
      ->check(CLI::Range(1, 16384))
      ->capture_default_str();
  app.add_option("--scene", request.scene,
                 "What to draw: as `footprint compare` takes it; if not given, ClearCoatTest");
  app.add_option("--methods", request.methods, "With --footprints and --bakes: the methods")->capture_default_str();
  app.footer(examples);
}

constexpr const char* description =
    "Benchmarks of Footprint; all --benchmark_... options of Google Benchmark work too.";

// Google Benchmark handles --help first and does not know the options above.
void print_help() {
  CLI::App app(description, "footprint_bench");
  Request request;
  declare_options(app, request);
  (void)std::fputs(app.help().c_str(), stdout);
  benchmark::PrintDefaultHelp();
}

void run(int argc, char** argv) {
  benchmark::Initialize(&argc, argv, print_help);  // removes the --benchmark_... options
  CLI::App app(description, "footprint_bench");
  Request request;
  declare_options(app, request);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error) == 0 ? 0 : static_cast<int>(footprint::ErrorKind::usage));
  }
  using namespace footprint::bench;
  if (request.footprint_rounds > 0)
    return print_footprint_sizes(request.methods, request.resolution, request.footprint_rounds, request.most_ratio);
  std::optional<footprint::Scene> scene = load_bench_scene(request.scene);
  if (request.bake_rounds > 0) {
    if (scene) print_bake_table(*scene, request.methods, request.bake_rounds, request.bake_limits);
    return;
  }
  if (scene) register_frame_benchmark(std::move(*scene));
  register_tan_gmm_benchmarks();
  register_iwasaki_benchmarks();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::ClearRegisteredBenchmarks();  // the OpenGL context of the frame ends with main
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
