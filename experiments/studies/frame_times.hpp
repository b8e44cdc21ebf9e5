// Frame times of a comparison: measured in turn, pooled over processes, and written into its records.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "experiments/studies/stage.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// Frame times of one process at one distance: [candidate][repeat], milliseconds; first the
/// stage's methods (whole frames), then the frame builds alone of those that have one, in the same order.
using DistanceTimes = std::vector<std::vector<double>>;

/// Those of one process at all distances.
using FrameTimes = std::vector<DistanceTimes>;

/// Whether more rounds would say little more of the ratio of `times` to `unit`, taken in the same rounds: the 95%
/// interval of its median is narrower than 3% of it.
[[nodiscard]] bool is_ratio_known(const std::vector<double>& times, const std::vector<double>& unit);

/// Those of one distance, all candidates in turn.
[[nodiscard]] DistanceTimes time_methods(const Stage& stage, const View& view, int repeats, const Progress& progress);

/// Of each of the stage's methods when its frame build runs; none: it has none.
[[nodiscard]] std::vector<std::optional<BuildTiming>> build_timings(const Stage& stage);

/// Fills in frame times, ratios and frame builds of the records of one distance, in the order of `builds`; medians are
/// over all processes, and every ratio is formed within one, to the method at `unit`, which costs 1. Where that one
/// failed, ratios are not known.
void set_times(std::span<const std::reference_wrapper<Record>> records,
               std::span<const std::optional<BuildTiming>> builds, std::span<const DistanceTimes> processes,
               std::size_t unit);

}  // namespace footprint
