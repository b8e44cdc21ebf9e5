// Fields and lines of comma-separated values after RFC 4180.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "results/report/records.hpp"

namespace footprint {

/// Text, quoted where it holds a comma, a quote or a line break.
[[nodiscard]] std::string csv_field(std::string_view text);

/// As many digits as it takes to read the same double back; empty for what is not finite, or absent.
[[nodiscard]] std::string csv_field(double value);
[[nodiscard]] std::string csv_field(const std::optional<double>& value);

inline constexpr std::string_view csv_line_end = "\r\n";

/// The names of the columns of results.csv, and one record below them; without an end of the line.
[[nodiscard]] std::string csv_header();
[[nodiscard]] std::string csv_line(const Record& record);

}  // namespace footprint
