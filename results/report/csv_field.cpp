// Quotes text and writes numbers for CSV.
#include "results/report/csv_field.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

namespace footprint {
namespace {

std::string csv_text(const nlohmann::ordered_json& value) {
  if (value.is_null()) return {};
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return fmt::format("{}", value.get<double>());
  if (!value.is_structured()) return value.dump();
  std::vector<std::string> parts;
  for (const auto& [name, part] : value.items())
    parts.push_back(value.is_object() ? fmt::format("{}={}", name, csv_text(part)) : csv_text(part));
  return fmt::format("{}", fmt::join(parts, ";"));
}

}  // namespace

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char character : text) quoted.append(character == '"' ? 2 : 1, character);
  return quoted + '"';
}

std::string csv_field(double value) { return std::isfinite(value) ? fmt::format("{}", value) : std::string(); }

std::string csv_field(const std::optional<double>& value) { return value ? csv_field(*value) : std::string(); }

std::string csv_header(std::span<const CsvColumn> columns) {
  std::vector<std::string_view> names;
  for (const CsvColumn& column : columns) names.push_back(column.name);
  return fmt::format("{}", fmt::join(names, ","));
}

std::string csv_line(std::span<const CsvColumn> columns, const nlohmann::ordered_json& document) {
  std::vector<std::string> values;
  for (const CsvColumn& column : columns) {
    const nlohmann::ordered_json::json_pointer place(column.place);
    values.push_back(document.contains(place) ? csv_field(csv_text(document.at(place))) : std::string());
  }
  return fmt::format("{}", fmt::join(values, ","));
}

}  // namespace footprint
