// Figures as readers see them: one way to write a number, the columns of a record, listed once for results.csv,
// table.md, the page and results.md, and comma-separated values after RFC 4180.
#pragma once

#include <algorithm>
#include <array>
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

/// The names of the columns of results.csv, and their values of a record; without an end of the line.
[[nodiscard]] std::string csv_header();
[[nodiscard]] std::string csv_line(const Record& record);

/// One line per record, RFC 4180; the header names every column.
[[nodiscard]] std::string results_csv(const Results& results);

/// A column of records and what reports say about it.
struct Column {
  std::string_view key;        ///< the name in results.csv and in the address of the page
  const char* place = "";      ///< JSON pointer into a record of results.json; empty: not in results.csv
  std::string_view unit;       ///< in results.md
  std::string_view title{};    ///< the heading in tables; empty: no table has the column
  std::string_view meaning{};  ///< on the page, and of some below table.md
  /// Writes the number at `place`, or several figures of the record; null: the tables write it themselves.
  std::string (*format)(const std::optional<double>& value, const Record& record) = nullptr;
  bool is_words = false;  ///< aligned left
};

/// All columns, in the order of results.csv.
[[nodiscard]] std::span<const Column> record_columns();

/// The column of that key. Throws std::logic_error if there is none.
[[nodiscard]] const Column& column_of(std::string_view key);

/// The cell of a column with a format.
/// json: the record as results.json has it.
[[nodiscard]] std::string cell_text(const Column& column, const Record& record, const nlohmann::ordered_json& json);

/// `text` with characters that a terminal's font lacks replaced: "–", "×", "’" and the no-break space.
[[nodiscard]] std::string plain(std::string_view text);

/// The columns of errors and of times, in the order of table.md and the page.
inline constexpr std::array<std::string_view, 10> error_columns{
    "rank",        "normalized_color_error", "shading_error",  "edges_error",    "filter_error", "method_error",
    "light_error", "representation_error",   "equivalent_spp", "interior_pixels"};
inline constexpr std::array<std::string_view, 5> time_columns{"frame_median_ms", "ratio_to_direct_median",
                                                              "frames_per_second", "fetches", "lobes"};

}  // namespace footprint
