// Benchmarks: of edits, mixtures and the bare frame for Google Benchmark; tables of bakes and of footprint sizes, with
// limits.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/bench_scene.hpp"
#include "renderer/pipeline/timing.hpp"

namespace footprint::bench {

/// Edits small-scale geometry, from a patch to the amplitudes of its lobes: each kind of patch at the paper's
/// discretisation, then more facets and normals.
void register_iwasaki_benchmarks();

/// Fits Tan's mixtures to all levels of a map, four Gaussians, neighbours aligned or not; items are texels of the
/// finest level.
void register_tan_gmm_benchmarks();

/// Draws the frame of the bare shader. `scene` must outlive the run.
void register_frame_benchmark(const BenchScene& scene);

/// The most that every bake may take; 0: no limit.
struct BakeLimits {
  double seconds = 0.0;    ///< wall clock of the quickest of all rounds: other load on the machine only adds to it
  double gigabytes = 0.0;  ///< 1e9 bytes: the process' peak, the scene that is baked included
};

/// A table of the bakes of a scene by methods of a list, `rounds` times each: wall clock and CPU time of the quickest
/// round, bytes, and the peak memory of the process until then. Errors (check): a bake takes more than it may,
/// with the table before it on stdout.
void print_bake_table(const Scene& scene, const std::string& methods, int rounds, const BakeLimits& limits);

/// Prints, for frames of 512 x 512 pixels by methods of a list, commas between, of a plane that repeats the map of the
/// surface `scratched_metal`, `resolution` texels per side, under one light: what they cost where every pixel's
/// footprint is a square of 1, 2, 4 ... texels per side, up to the whole map. CPU times, medians over `repeats` rounds,
/// with the lookups per pixel, and the greatest over the median of all sizes of both. Errors (usage): unknown method or
/// option; (check): the greatest time of a method is more than `most_ratio` times its median (0: no limit).
void print_footprint_sizes(const std::string& methods, int resolution, int repeats, double most_ratio);

/// Milliseconds, [candidate][repeat]. CPU time is that of all threads of the process: other load on the machine hardly
/// moves it, while wall clock shows what a user waits for.
struct WallAndCpu {
  std::vector<std::vector<double>> wall, cpu;
};

/// Draws every candidate once in each of `repeats` rounds, after one round that warms up.
[[nodiscard]] WallAndCpu side_by_side(const gl::ContextInfo& context, std::span<const DrawFrame> candidates,
                                      int repeats);

/// A table with median, min, max and the middle 80% of each ratio: `direct` against the bare shader, every method
/// against the one called `over`, and the 64-sample reference against 64 frames of `direct`. `repeats` pairs of frames;
/// a tenth of them, at least 5, for the reference. Errors (usage): `over` is none of the scene's methods.
[[nodiscard]] std::string ratio_table(const BenchScene& scene, const std::string& over, int repeats);

}  // namespace footprint::bench
