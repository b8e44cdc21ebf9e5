// Frames in turns, and quantiles of their times and of ratios of neighbours.
#include "renderer/pipeline/timing.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>

#include "renderer/gl/objects.hpp"

namespace footprint {
namespace {

/// How long a GPU draws before its frames are timed, so that its clocks rise from idle: an H100 drew five times slower
/// during the first half second.
constexpr std::chrono::duration<double> gpu_warm_up(1.0);

double time_frame(gl::FrameTimer& timer, const DrawFrame& draw) {
  timer.begin();
  draw();
  return timer.end_ms();
}

// At least one round.
void warm_up(const gl::ContextInfo& context, gl::FrameTimer& timer, std::span<const DrawFrame> candidates) {
  const auto start = std::chrono::steady_clock::now();
  do {
    for (const DrawFrame& draw : candidates) time_frame(timer, draw);
  } while (!context.software && std::chrono::steady_clock::now() - start < gpu_warm_up);
}

}  // namespace

RepeatedTimes interleaved_times(const gl::ContextInfo& context, std::span<const DrawFrame> candidates, int repeats,
                                const Progress& progress, const std::function<bool(const RepeatedTimes&)>& is_enough) {
  gl::FrameTimer timer(context);
  RepeatedTimes times(candidates.size());
  progress("timing frames", 0.0);
  warm_up(context, timer, candidates);
  for (int repeat = 0; repeat < repeats; ++repeat) {
    progress("timing frames", static_cast<double>(repeat + 1) / (repeats + 1));
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const std::size_t candidate = (i + static_cast<std::size_t>(repeat + 1)) % candidates.size();
      times[candidate].push_back(time_frame(timer, candidates[candidate]));
    }
    if (is_enough && is_enough(times)) break;
  }
  return times;
}

double quantile(std::vector<double> values, double q) {
  std::ranges::sort(values);
  const double rank = q * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return std::lerp(values[below], values[above], rank - static_cast<double>(below));
}

MedianInterval median_interval(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t count = values.size();
  constexpr double one_side = 0.025;
  // P(fewer than k + 1 of the values lie below the median), for k = 0, 1, ...; each is there with probability 1/2.
  double term = std::pow(0.5, static_cast<double>(count)), below = term;
  std::size_t k = 0;
  while (k + 1 < count - k && below <= one_side) {
    ++k;
    term *= static_cast<double>(count - k + 1) / static_cast<double>(k);
    below += term;
  }
  const std::size_t first = k > 0 ? k - 1 : 0;
  return {.low = values[first], .high = values[count - 1 - first]};
}

std::vector<double> paired_ratios(std::span<const double> a, std::span<const double> b) {
  std::vector<double> ratios(a.size());
  std::ranges::transform(a, b, ratios.begin(), [](double x, double y) { return x / y; });
  return ratios;
}

}  // namespace footprint
