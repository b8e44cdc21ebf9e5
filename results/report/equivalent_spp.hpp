// Equivalent samples: the samples per pixel with which plain supersampling reaches a method's error.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "results/report/records.hpp"

namespace footprint {

/// One measured point of a supersampling curve.
struct CurvePoint {
  double spp = 1;    ///< samples per pixel, above 0
  double error = 0;  ///< any error measure, 0 or more; the same measure all along the curve
};

/// The curve of one distance by one of its errors, without the counts whose error could not be measured.
[[nodiscard]] std::vector<CurvePoint> supersampling_curve(
    std::span<const SupersamplingPoint> points, double distance,
    std::optional<double> SupersamplingPoint::*error = &SupersamplingPoint::normalized_color);

/// The largest spp at which the curve still has at least `error`: up to there the method is worth that many samples
/// on every reading of a noisy curve that rises again. Between two points the curve is a straight line of log(error)
/// over log(spp), or of error over log(spp) where one end is 0. A method worse than the whole curve is below its first
/// count, one better than its last point is above its last count. None without a curve. Points in any order.
/// Errors (usage): a count that is not above 0, or an error that is negative, NaN or infinite.
[[nodiscard]] std::optional<EquivalentSamples> equivalent_samples(std::span<const CurvePoint> curve, double error);

}  // namespace footprint
