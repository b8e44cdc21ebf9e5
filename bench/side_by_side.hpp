// Times of several things drawn in turn, round after round.
#pragma once

#include <span>
#include <vector>

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

}  // namespace footprint::bench
