// Fields of comma-separated values after RFC 4180.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace footprint {

/// Text, quoted where it holds a comma, a quote or a line break.
[[nodiscard]] std::string csv_field(std::string_view text);

/// As many digits as it takes to read the same double back; empty for what is not finite, or absent.
[[nodiscard]] std::string csv_field(double value);
[[nodiscard]] std::string csv_field(const std::optional<double>& value);

}  // namespace footprint
