// Conclusions from the errors of a run: which methods differ beyond noise, over how many pixels, and the samples per
// pixel with which plain supersampling reaches a method's error.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
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

/// Interior pixels below which a distance is marked, and below which it is not ranked.
inline constexpr std::size_t few_pixels = 100, too_few_pixels = 20;

/// The records of one distance, in the order of the run.
using DistanceRecords = std::vector<std::reference_wrapper<const Record>>;
[[nodiscard]] DistanceRecords records_at(const Results& results, double distance);

/// The error that methods are ranked by: shading, over interior pixels. None without one, or over too few pixels.
[[nodiscard]] std::optional<double> ranked_error(const Record& record);

/// Whether the record is that of single frames of `direct`, which others are compared with.
[[nodiscard]] inline bool is_unit_frame(const Record& record) { return record.method == "direct" && !record.history; }

/// Whether `a` is better than `b` by more than the reference's own noise over those pixels explains: by three standard
/// errors of the difference. Never where that noise is not known.
[[nodiscard]] bool is_better(const Record& a, const Record& b);

/// The place of a record among those of its distance: 1 and the number of those that are better beyond noise. Several
/// may share one. None where it is not ranked.
[[nodiscard]] std::optional<int> rank(const Record& record, const DistanceRecords& records);

/// That measures of linear radiance rest on a few bright pixels at a distance, where the reference's standard error
/// there (over mean radiance) is as large as that. Errors of clamped values, which methods are ranked by, do not.
[[nodiscard]] std::optional<std::string> linear_measures_warning(double distance,
                                                                 const std::optional<double>& standard_error);

/// The limits of the ranking, which a reader must know first, one sentence each: a reference that has not converged,
/// distances with few interior pixels, with differences below the noise, or with nothing to filter. Of an animation:
/// the frames in which the reference has not converged.
[[nodiscard]] std::vector<std::string> ranking_warnings(const Results& results);

/// "12,345 object pixels, 8,100 of them interior (66%); noise floor 0.00017, over interior pixels 0.00012.", of a
/// distance any of whose records this is.
[[nodiscard]] std::string pixels_and_noise(const Record& record);

/// The share of interior pixels in which `method` is closer to the reference than `other`, beyond noise. None where
/// that was not measured.
[[nodiscard]] std::optional<double> closer_share(const Results& results, double distance, const std::string& method,
                                                 const std::string& other);

/// The findings at one distance, in sentences: which methods are best and which do not differ, what the best
/// one costs and what it is worth, in how many pixels it is closer than the next, what the bound leaves, and what edges
/// add.
[[nodiscard]] std::vector<std::string> findings(const Results& results, double distance);

}  // namespace footprint
