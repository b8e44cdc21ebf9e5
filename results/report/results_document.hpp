// The content of results.json as a JSON value, for the file and for the page that carries it.
#pragma once

#include <nlohmann/json.hpp>

#include "results/report/records.hpp"

namespace footprint {

/// What `"schema"` says in every results.json that this version writes and reads.
inline constexpr const char* results_schema = "footprint-results/1";

/// The document of docs/results.schema.json, keys in its order; NaN, infinities and absent figures are null.
[[nodiscard]] nlohmann::ordered_json results_document(const Results& results);

/// JSON text; bytes that are no UTF-8 become U+FFFD. `indent` as nlohmann::json::dump (-1: one line).
[[nodiscard]] std::string json_text(const nlohmann::ordered_json& document, int indent);

}  // namespace footprint
