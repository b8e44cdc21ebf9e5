// Quotes text and writes numbers for CSV, and writes results.csv from the list of columns.
#include "results/report/csv_field.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "results/report/columns.hpp"
#include "results/report/record_fields.hpp"
#include "results/report/report.hpp"

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

std::span<const CsvColumn> columns_of_results() {
  static const std::vector<CsvColumn> columns = [] {
    std::vector<CsvColumn> found;
    for (const Column& column : record_columns()) {
      if (*column.place != '\0') found.push_back({column.key, column.place});
    }
    return found;
  }();
  return columns;
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

std::string csv_header() { return csv_header(columns_of_results()); }

std::string csv_line(const Record& record) { return csv_line(columns_of_results(), to_json_value(record)); }

std::string results_csv(const Results& results) {
  std::string csv = csv_header().append(csv_line_end);
  for (const Record& record : results.records) csv.append(csv_line(record)).append(csv_line_end);
  return csv;
}

}  // namespace footprint
