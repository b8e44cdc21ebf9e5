// Frame times that compare: frames of all candidates interleaved in one process, so that whatever else the machine does
// falls on all of them alike.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "renderer/core/progress.hpp"
#include "renderer/gl/context.hpp"

namespace footprint {

/// Draws one frame, without waiting for it and without reading it.
using DrawFrame = std::function<void()>;

/// Times by candidate and repeat, milliseconds.
using RepeatedTimes = std::vector<std::vector<double>>;

/// One untimed round warms up; then each repeat draws one frame of every candidate, starting each time with another
/// one, until there are `repeats` or `is_enough` says so after one. Software renderers: wall clock around glFinish;
/// GPUs: timer queries.
[[nodiscard]] RepeatedTimes interleaved_times(const gl::ContextInfo& context, std::span<const DrawFrame> candidates,
                                              int repeats, const Progress& progress,
                                              const std::function<bool(const RepeatedTimes&)>& is_enough = {});

/// Milliseconds of each of `repeats` draws of one candidate that has been drawn before: no warming up, nothing
/// interleaved.
[[nodiscard]] std::vector<double> repeated_times(const gl::ContextInfo& context, const DrawFrame& draw, int repeats,
                                                 const Progress& progress);

/// The q-quantile, 0 to 1, of a sample by linear interpolation between order statistics. `values` must not be empty.
[[nodiscard]] double quantile(std::vector<double> values, double q);

/// An interval of a sample, by two of its order statistics.
struct MedianInterval {
  double low = 0, high = 0;
};

/// The interval that has the population's median with a probability of at least 95%, whatever the distribution: from
/// the k-th smallest to the k-th largest value, k by the binomial distribution (of 9 the 2nd to the 8th). Fewer than 6
/// values have none: their least and most. `values` must not be empty.
[[nodiscard]] MedianInterval median_interval(std::vector<double> values);

/// a[i] / b[i] for frames drawn in the same repeat.
[[nodiscard]] std::vector<double> paired_ratios(std::span<const double> a, std::span<const double> b);

}  // namespace footprint
