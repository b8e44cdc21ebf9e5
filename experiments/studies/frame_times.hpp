// Frame times of a comparison: measured in turn, pooled over processes, and written into its records.
#pragma once

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
[[nodiscard]] DistanceTimes time_methods(const Stage& stage, const View& view, const RunSettings& settings,
                                         const Progress& progress);

/// Fills in frame times, ratios and frame builds of the records of one distance.
/// records: one per method of the stage's settings, in their order.
/// processes: the times of each process. Medians are over all of them, and every ratio is formed within one process, to
/// the stage's unit, which costs 1. If the unit failed, ratios are unknown.
void set_times(std::span<Record> records, const Stage& stage, std::span<const DistanceTimes> processes);

/// Marks the times of a record as not measured.
void set_no_times(Record& record);

}  // namespace footprint
