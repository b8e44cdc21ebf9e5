// CPU time is counted around each drawing and its glFinish, wall time by interleaved_times, whose warm-up is dropped.
#include "bench/side_by_side.hpp"

#include <ctime>

#include "renderer/gl/functions.hpp"

namespace footprint::bench {

WallAndCpu side_by_side(const gl::ContextInfo& context, std::span<const DrawFrame> candidates, int repeats) {
  WallAndCpu times;
  times.cpu.resize(candidates.size());
  std::vector<DrawFrame> measured;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    measured.emplace_back([&, i] {
      const std::clock_t start = std::clock();
      candidates[i]();
      gl::api().Finish();
      times.cpu[i].push_back(1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    });
  }
  times.wall = interleaved_times(context, measured, repeats, no_progress);
  for (std::vector<double>& cpu : times.cpu) cpu.erase(cpu.begin());  // the round that warms up
  return times;
}

}  // namespace footprint::bench
