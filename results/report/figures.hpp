// Numbers as readers see them: one way to write each, and comma-separated values after RFC 4180.
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

/// Overload for an optional error: "n/a" without one.
[[nodiscard]] std::string error_text(const std::optional<double>& error);

/// "at most 9 frames of each method in one process, in turn"
[[nodiscard]] std::string timing_text(const TimingInfo& timing);

/// "0.01200 to 0.03400", or one of them where both read alike.
[[nodiscard]] std::string range_text(double low, double high);

/// Three figures, never an exponent up to a million: "0.0123", "1.31", "41.2", "1234".
[[nodiscard]] std::string three_figures(double value);

/// "1.31 (1.25-1.40)": the median and the ends of the spread; "n/a" for figures that were not measured.
[[nodiscard]] std::string spread_text(double median, double low, double high);

/// "1.31 (1.25-1.40)": the median, and the interval of the median.
[[nodiscard]] std::string ratio_text(const TimeRatio& ratio);

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

/// The value with as many digits as reading the same double back takes; empty if it is absent or not finite.
[[nodiscard]] std::string csv_field(const std::optional<double>& value);

/// A value of a document: null is empty, a list "a;b", an object "name=value;name=value".
[[nodiscard]] std::string csv_value(const nlohmann::ordered_json& value);

inline constexpr std::string_view csv_line_end = "\r\n";

/// `text` with characters that a terminal's font lacks replaced: "–", "×", "’" and the no-break space.
[[nodiscard]] std::string plain(std::string_view text);

}  // namespace footprint
