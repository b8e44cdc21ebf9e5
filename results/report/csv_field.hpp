// Fields and lines of comma-separated values after RFC 4180.
#pragma once

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

}  // namespace footprint
