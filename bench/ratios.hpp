// Ratios of frame times, each pair drawn side by side: what stays true on a busy machine.
#pragma once

#include <string>

#include "bench/bench_scene.hpp"

namespace footprint::bench {

/// A table with median, min, max and the middle 80% of each ratio: `direct` against the bare shader, every method
/// against the one called `over`, and the 64-sample reference against 64 frames of `direct`. `repeats` pairs of frames;
/// a tenth of them, at least 5, for the reference. Errors (usage): `over` is none of the scene's methods.
[[nodiscard]] std::string ratio_table(const BenchScene& scene, const std::string& over, int repeats);

}  // namespace footprint::bench
