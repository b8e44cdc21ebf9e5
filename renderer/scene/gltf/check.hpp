// Refuses glTF JSON that is ill-typed or points outside itself, before tinygltf and we rely on it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace footprint {

/// Parses JSON with a limit on its nesting. Errors (usage): not JSON, nested over 64 deep.
[[nodiscard]] nlohmann::json parse_gltf_json(std::string_view text);

/// Checks all of a glTF 2.0 document that Footprint or tinygltf reads: version, required extensions, types, numbers of
/// array elements, indices within the arrays that they point into, buffer views within their buffers, URIs.
/// Errors (usage) name the place as "meshes[0].primitives[1].indices".
void check_gltf_json(const nlohmann::json& document);

/// Whether an extension is honoured.
[[nodiscard]] bool reads_gltf_extension(std::string_view name);

/// What an extension that is left out adds to a surface, in words: "sheen". Empty where it is none that only adds
/// something, so that a file which requires it cannot be shown without.
[[nodiscard]] std::string_view gltf_layer(std::string_view name);

}  // namespace footprint
