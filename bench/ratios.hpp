// Times of frames that are drawn in turn, round after round, and their ratios, which other load hardly changes.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/bench_scene.hpp"
#include "renderer/pipeline/timing.hpp"

namespace footprint::bench {

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
