// The columns of a record, listed once: results.csv, table.md, the page and results.md are written from this list. And
// comma-separated values after RFC 4180.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "results/report/records.hpp"

namespace footprint {

/// Text, quoted if it contains a comma, a quote or a line break.
[[nodiscard]] std::string csv_field(std::string_view text);

/// As many digits as reading the same double back takes; empty if it is absent or not finite.
[[nodiscard]] std::string csv_field(double value);
[[nodiscard]] std::string csv_field(const std::optional<double>& value);

inline constexpr std::string_view csv_line_end = "\r\n";

/// A column and the place of its value in a JSON document.
struct CsvColumn {
  std::string_view name;
  const char* place;  ///< JSON pointer
};

/// The names of columns, and their values in `document`; without an end of the line. An absent or null value is empty,
/// a list "a;b", an object "name=value;name=value".
[[nodiscard]] std::string csv_header(std::span<const CsvColumn> columns);
[[nodiscard]] std::string csv_line(std::span<const CsvColumn> columns, const nlohmann::ordered_json& document);

/// The same of results.csv.
[[nodiscard]] std::string csv_header();
[[nodiscard]] std::string csv_line(const Record& record);

/// A column of records and what reports say about it.
struct Column {
  std::string_view key;        ///< the name in results.csv and in the address of the page
  const char* place = "";      ///< JSON pointer into a record of results.json; empty: not in results.csv
  std::string_view unit;       ///< in results.md
  std::string_view title{};    ///< the heading in tables; empty: no table has the column
  std::string_view meaning{};  ///< on the page
  std::string_view note{};     ///< below table.md
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

/// `text` with characters that a terminal's font lacks replaced: "–", "×" and the no-break space.
[[nodiscard]] std::string plain(std::string_view text);

/// The columns of errors and of times, in the order of table.md and the page.
inline constexpr std::array<std::string_view, 10> error_columns{
    "rank",        "normalized_color_error", "shading_error",  "edges_error",    "filter_error", "method_error",
    "light_error", "representation_error",   "equivalent_spp", "interior_pixels"};
inline constexpr std::array<std::string_view, 5> time_columns{"frame_median_ms", "ratio_to_direct_median",
                                                              "frames_per_second", "fetches", "lobes"};

}  // namespace footprint
