// The content of results.json as a JSON value, for the file and for the page that carries it.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "results/report/records.hpp"

namespace footprint {

/// What `"schema"` says in every results.json that this version writes.
inline constexpr const char* results_schema = "footprint-results/2";

/// The document of docs/results.schema.json, keys in its order; NaN, infinities and absent figures are null.
[[nodiscard]] nlohmann::ordered_json results_document(const Results& results);

// Parts that other documents have too; absent figures and those that are not finite are null.
[[nodiscard]] nlohmann::ordered_json json_number(const std::optional<double>& value);
[[nodiscard]] nlohmann::ordered_json tool_json(const ToolInfo& tool);
[[nodiscard]] nlohmann::ordered_json backend_json(const BackendInfo& backend);
[[nodiscard]] nlohmann::ordered_json scene_json(const SceneInfo& scene);
[[nodiscard]] nlohmann::ordered_json reference_json(const ReferenceInfo& reference);
[[nodiscard]] nlohmann::ordered_json flicker_json(const std::optional<Flicker>& flicker);

/// JSON text; bytes that are no UTF-8 become U+FFFD. `indent` as nlohmann::json::dump (-1: one line).
[[nodiscard]] std::string json_text(const nlohmann::ordered_json& document, int indent);

}  // namespace footprint
