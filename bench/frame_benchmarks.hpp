// Benchmarks of what is drawn: one frame of every method and of the yardstick, the reference, baking.
#pragma once

#include "bench/bench_scene.hpp"

namespace footprint::bench {

/// Registers them with Google Benchmark; `scene` must outlive the run.
void register_frame_benchmarks(const BenchScene& scene);

/// Registers what happens before the first frame: a context, loading the scene, and all of it up to a first frame of
/// `direct`. `scene`'s context is made current again after each.
void register_start_up_benchmarks(const BenchScene& scene);

}  // namespace footprint::bench
