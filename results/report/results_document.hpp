// The content of results.json as a JSON value, for the file and for the page that contains it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "results/report/records.hpp"

namespace footprint {

/// The value of `"schema"` in every results.json that this version writes.
inline constexpr const char* results_schema = "footprint-results/2";

/// The document of docs/results.schema.json, keys in its order; NaN, infinities and absent figures are null.
[[nodiscard]] nlohmann::ordered_json results_document(const Results& results);

/// A number; null if it is absent or not finite.
[[nodiscard]] nlohmann::ordered_json json_number(const std::optional<double>& value);

/// JSON text; bytes that are not UTF-8 become U+FFFD.
/// indent: spaces per level, or -1 for one line.
[[nodiscard]] std::string json_text(const nlohmann::ordered_json& document, int indent);

}  // namespace footprint
