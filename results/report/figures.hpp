// Numbers as readers see them: one way to write each, and comma-separated values after RFC 4180. And the conclusions
// from the errors of a run: which methods differ beyond noise, over how many pixels, and the samples per pixel with
// which plain supersampling reaches a method's error.
#pragma once

#include <algorithm>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "results/report/records.hpp"

namespace footprint {

/// An error between 0 and 1: five decimals, or two figures and an exponent where those would hide it.
[[nodiscard]] std::string error_text(double error);

/// The same of an error that there may not be: "n/a" without one.
[[nodiscard]] std::string error_text(const std::optional<double>& error);

/// "at most 9 frames of each method in one process, in turn"
[[nodiscard]] std::string timing_text(const TimingInfo& timing);

/// "0.01200 to 0.03400", or one of them where both read alike.
[[nodiscard]] std::string range_text(double low, double high);

/// Three figures, never an exponent up to a million: "0.0123", "1.31", "41.2", "1234".
[[nodiscard]] std::string three_figures(double value);

/// "1.31 (1.25-1.40)": the median and the ends of the spread; "n/a" for figures that were not measured.
[[nodiscard]] std::string spread_text(double median, double low, double high);

/// The samples that a record is worth, where the curve of plain supersampling reaches its error.
[[nodiscard]] std::optional<double> equivalent_spp(const Record& record);

/// The end of that curve if it is before a record's error: "<1", ">64"; empty within the curve, "n/a"
/// without an error or a curve.
[[nodiscard]] std::string equivalent_bound(const Record& record);

/// "41", "1.5", or the bound.
[[nodiscard]] std::string equivalent_text(const Record& record);

/// Whether the reference's own noise explains the error over all of the object.
[[nodiscard]] bool at_noise_floor(const Record& record);

/// Whether it explains the shading error.
[[nodiscard]] bool shading_at_noise_floor(const Record& record);

/// "a, b, c", or `none` for an empty list.
[[nodiscard]] std::string list_text(const std::vector<std::string>& words, const std::string& none);

/// One labelled line of where the figures come from.
struct Provenance {
  std::string label, value;
};
void fields(auto& archive, Is<Provenance> auto& value) {
  archive("label", value.label);
  archive("value", value.value);
}

/// Backend, processor, scene, exposure, reference, what was supplied and what was left out: the head of every report.
[[nodiscard]] std::vector<Provenance> provenance(const Results& results);

/// The distances of the records, in the order in which they first appear.
[[nodiscard]] std::vector<double> distances_of(const Results& results);

/// The methods of any records, in the order in which they first appear.
template <typename Records>
[[nodiscard]] std::vector<std::string> methods_in_order(const Records& records) {
  std::vector<std::string> methods;
  for (const auto& record : records) {
    if (std::ranges::find(methods, record.method) == methods.end()) methods.push_back(record.method);
  }
  return methods;
}

/// Text, quoted if it contains a comma, a quote or a line break.
[[nodiscard]] std::string csv_field(std::string_view text);

/// As many digits as reading the same double back takes; empty if it is absent or not finite.
[[nodiscard]] std::string csv_field(const std::optional<double>& value);

/// A value of a document: null is empty, a list "a;b", an object "name=value;name=value".
[[nodiscard]] std::string csv_value(const nlohmann::ordered_json& value);

inline constexpr std::string_view csv_line_end = "\r\n";

/// `text` with characters that a terminal's font lacks replaced: "–", "×", "’" and the no-break space.
[[nodiscard]] std::string plain(std::string_view text);

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

/// "1.31 (1.25-1.40)": the median, and the interval of the median.
[[nodiscard]] std::string ratio_text(const TimeRatio& ratio);

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

/// The answer at one distance.
struct DistanceAnswer {
  std::vector<std::string> sentences;  ///< the most accurate; then the cheapest that improves on `direct`, if another
  std::vector<std::string> methods = {};  ///< to show: `direct`, that cheapest one, the most accurate; what there is
};
[[nodiscard]] DistanceAnswer answer_at(const Results& results, double distance);

/// "-59%": the record's error over that of `direct` at its distance; empty for `direct`, and if either is not known.
[[nodiscard]] std::string change_from_direct(const Results& results, const Record& record);

/// The findings at one distance, in sentences: which methods are best and which do not differ, what the best
/// one costs and what it is worth, in how many pixels it is closer than the next, what the bound leaves, and what edges
/// add.
[[nodiscard]] std::vector<std::string> findings(const Results& results, double distance);

}  // namespace footprint
