// Quotes text and writes numbers for CSV.
#include "results/report/csv_field.hpp"

#include <fmt/format.h>

#include <cmath>

namespace footprint {

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char character : text) quoted.append(character == '"' ? 2 : 1, character);
  return quoted + '"';
}

std::string csv_field(double value) { return std::isfinite(value) ? fmt::format("{}", value) : std::string(); }

std::string csv_field(const std::optional<double>& value) { return value ? csv_field(*value) : std::string(); }

}  // namespace footprint
