// The structure of a JSON schema: types, words, properties with their order, and lengths. Descriptions, limits,
// patterns and conditions are written by hand.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace footprint::test {

/// Compares a schema with the structure that the fields give (schema_archive.hpp).
/// structure: without `$ref`
/// schema: draft 7; a `$ref` leads into the same schema
/// Returns one line per difference, which begins with its place, such as "/records/*/time/fps"; `*` is any element of
/// an array or any key of a map. A number may also be null, because numbers that are not finite are. A missing
/// description is a difference.
[[nodiscard]] std::vector<std::string> schema_differences(const nlohmann::ordered_json& structure,
                                                          const nlohmann::ordered_json& schema);

/// The schema with the given structure. The rest of it remains, such as descriptions and limits of properties that
/// exist in both. New properties get an empty description.
[[nodiscard]] nlohmann::ordered_json with_structure(const nlohmann::ordered_json& structure,
                                                    nlohmann::ordered_json schema);

}  // namespace footprint::test
