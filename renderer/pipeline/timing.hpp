// Comparable frame times: frames of all candidates are interleaved in one process, so that other load on the machine
// affects all of them equally.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "renderer/core/progress.hpp"
#include "renderer/gl/context.hpp"

namespace footprint {

/// Draws one frame without waiting for it or reading it back.
using DrawFrame = std::function<void()>;

/// Times by candidate and repeat, milliseconds.
using RepeatedTimes = std::vector<std::vector<double>>;

/// One untimed round warms up; on a GPU, a second of rounds, until its clocks have risen. Then each repeat draws one
/// frame of every candidate, each time in another order. Software renderers use the wall clock around glFinish, GPUs
/// timer queries. repeats: at most so many; stops earlier if `is_enough` returns true.
[[nodiscard]] RepeatedTimes interleaved_times(const gl::ContextInfo& context, std::span<const DrawFrame> candidates,
                                              int repeats, const Progress& progress,
                                              const std::function<bool(const RepeatedTimes&)>& is_enough = {});

/// The q-quantile by linear interpolation between order statistics.
/// values: not empty. q: 0 to 1.
[[nodiscard]] double quantile(std::vector<double> values, double q);

/// An interval between two order statistics of a sample.
struct MedianInterval {
  double low = 0, high = 0;
};

/// A confidence interval of at least 95% for the median of any distribution: from the k-th smallest to the k-th largest
/// value, k by the binomial distribution (of 9 values the 2nd to the 8th). Of fewer than 6 values, the whole range.
/// values: not empty.
[[nodiscard]] MedianInterval median_interval(std::vector<double> values);

/// a[i] / b[i], for frames of the same repeat.
[[nodiscard]] std::vector<double> paired_ratios(std::span<const double> a, std::span<const double> b);

}  // namespace footprint
