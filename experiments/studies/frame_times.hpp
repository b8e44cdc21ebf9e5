// Frame times of a comparison: measured in turn, pooled over processes, and written into its records.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "experiments/studies/stage.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// Frame times of one process at one distance: [candidate][repeat], milliseconds; candidate 0 is `direct`, then the
/// methods in the order of the settings (whole frames), then the frame builds alone of those that have one, in the same
/// order.
using DistanceTimes = std::vector<std::vector<double>>;

/// Those of one process at all distances.
using FrameTimes = std::vector<DistanceTimes>;

/// Those of one distance, all candidates in turn. The stage's first method is `direct`.
[[nodiscard]] DistanceTimes time_methods(const Stage& stage, const View& view, int repeats, const Progress& progress);

/// Of each of the stage's methods but its first when its frame build runs; none: it has none.
[[nodiscard]] std::vector<std::optional<BuildTiming>> build_timings(const Stage& stage);

/// Fills in frame times, ratios and frame builds of the records of one distance, which stand in the order of `builds`;
/// medians are over all processes, and every ratio is formed within one.
void set_times(std::span<const std::reference_wrapper<Record>> records,
               std::span<const std::optional<BuildTiming>> builds, std::span<const DistanceTimes> processes);

}  // namespace footprint
