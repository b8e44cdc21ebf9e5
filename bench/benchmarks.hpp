// Benchmarks: of edits, mixtures and the bare frame for Google Benchmark; tables of bakes and of footprint sizes, with
// limits.
#pragma once

#include <optional>
#include <string>

#include "experiments/settings/run_settings.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint::bench {

/// The scene of a name or path; an empty `name` is ClearCoatTest without its coats under the supplied lamps alone, as
/// it has always been timed: none where its package (assimp-testmodels) is not installed, after a line on stderr that
/// says so. Errors: those of load_scene.
[[nodiscard]] std::optional<Scene> load_bench_scene(const std::string& name);

/// Frames of 512 x 512 pixels by `direct` and the methods of a comma-separated list. Errors (usage): unknown method or
/// option.
[[nodiscard]] RunSettings bench_settings(const std::string& methods);

/// Edits small-scale geometry, from a patch to the amplitudes of its lobes: each kind of patch at the paper's
/// discretisation, then more facets and normals.
void register_iwasaki_benchmarks();

/// Fits Tan's mixtures to all levels of a map, four Gaussians, neighbours aligned or not; items are texels of the
/// finest level.
void register_tan_gmm_benchmarks();

/// Draws the frame of the bare shader (bare_fragment.glsl).
void register_frame_benchmark(Scene scene);

/// The most that every bake may take; 0: no limit.
struct BakeLimits {
  double seconds = 0.0;    ///< wall clock of the quickest of all rounds: other load on the machine only adds to it
  double gigabytes = 0.0;  ///< 1e9 bytes: the process' peak, the scene that is baked included
};

/// A table of the bakes of a scene by methods of a list, `rounds` times each: wall clock and CPU time of the quickest
/// round, bytes, and the peak memory of the process until then. Errors (check): a bake takes more than it may,
/// with the table before it on stdout.
void print_bake_table(const Scene& scene, const std::string& methods, int rounds, const BakeLimits& limits);

/// Prints, for frames of bench_settings of a plane that repeats the map of the surface `scratched_metal`, `resolution`
/// texels per side, under one light: what they cost where every pixel's footprint is a square of 1, 2, 4 ... texels per
/// side, up to the whole map. CPU times, medians over `repeats` rounds, with the lookups per pixel, and the greatest
/// over the median of all sizes of both. Errors (usage): unknown method or option; (check): the greatest time of a
/// method is more than `most_ratio` times its median (0: no limit).
void print_footprint_sizes(const std::string& methods, int resolution, int repeats, double most_ratio);

}  // namespace footprint::bench
