// Frame times of a comparison: measured in turn, pooled over processes, and written into its records.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "experiments/studies/stage.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// Frame times of one process: [distance][candidate][repeat], milliseconds; candidate 0 is `direct`, then the methods
/// in the order of the settings (whole frames), then the frame builds alone of those that have one, in the same order.
using FrameTimes = std::vector<std::vector<std::vector<double>>>;

/// Those of one distance: [candidate][repeat], all candidates in turn. The stage's first method is `direct`.
[[nodiscard]] std::vector<std::vector<double>> time_methods(const Stage& stage, const View& view, int repeats,
                                                            const Progress& progress);

/// Fills in frame times, ratios and frame builds of the records of one distance, which stand in the order of the
/// stage's methods but its first; medians are over all processes.
void set_times(std::span<const std::reference_wrapper<Record>> records, const Stage& stage,
               std::span<const FrameTimes> processes, std::size_t distance);

}  // namespace footprint
