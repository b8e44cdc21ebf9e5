// Bakes one after the other, without a disk cache; memory is what the system has counted.
#include "bench/benchmarks.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <limits>

#include "methods/registry.hpp"
#include "renderer/core/error.hpp"
#include "renderer/effects/effects.hpp"

namespace footprint::bench {
namespace {

// The peak memory of the process so far, in units of 1e9 bytes.
double most_gigabytes() {
  rusage usage{};
  (void)getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024e-9;  // Linux counts kibibytes
}

struct Bake {
  double seconds = std::numeric_limits<double>::infinity();
  double cpu_seconds = 0.0;
  std::size_t bytes = 0;
};

Bake quickest(const MethodSpec& spec, const Scene& scene, const EffectSet& effects, int rounds) {
  Bake best;
  for (int i = 0; i < rounds; ++i) {
    const std::clock_t cpu = std::clock();
    const auto start = std::chrono::steady_clock::now();
    const std::size_t bytes = bake(find_method(spec), spec, scene, effects, no_progress).bytes;
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (seconds < best.seconds) best = {seconds, static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC, bytes};
  }
  return best;
}

void check_limit(const std::string& name, double value, double most, const char* unit) {
  if (most <= 0.0 || value <= most) return;
  throw Error(ErrorKind::check, name, fmt::format("its bake took {:.3g} {}, {:.3g} are allowed", value, unit, most));
}

}  // namespace

void print_bake_table(const Scene& scene, const std::string& methods, int rounds, const BakeLimits& limits) {
  const EffectSet effects = effects_on(derive_effects(scene));
  std::string text = fmt::format("{:<44} {:>10} {:>10} {:>10} {:>10}\n", "bake", "wall, s", "CPU, s", "MB", "peak, GB");
  for (const MethodSpec& spec : parse_methods(methods)) {
    const Bake best = quickest(spec, scene, effects, rounds);
    const double gigabytes = most_gigabytes();
    fmt::print("{}{:<44} {:>10.2f} {:>10.2f} {:>10.1f} {:>10.2f}\n", text, spec.text, best.seconds, best.cpu_seconds,
               static_cast<double>(best.bytes) * 1e-6, gigabytes);
    (void)std::fflush(stdout);
    text.clear();
    check_limit(spec.text, best.seconds, limits.seconds, "s");
    check_limit(spec.text, gigabytes, limits.gigabytes, "GB");
  }
}

}  // namespace footprint::bench
