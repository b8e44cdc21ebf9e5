// Checks of glTF JSON, because tinygltf 2.7 and this loader rely on its types and indices.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "renderer/core/error.hpp"

namespace footprint {

[[noreturn]] inline void refuse_gltf(const std::string& place, const std::string& message,
                                     const std::string& hint = "repair the file or export it again") {
  throw Error(ErrorKind::usage, place, message, hint);
}

/// Parses JSON with a limit on its nesting. Throws Error (usage): not JSON, nested over 64 deep.
[[nodiscard]] nlohmann::json parse_gltf_json(std::string_view text);

/// Checks everything in a glTF 2.0 document that Footprint or tinygltf reads: version, required extensions, types,
/// array sizes, indices, buffer views within their buffers, and URIs. Throws Error (usage) with a place such as
/// "meshes[0].primitives[1].indices".
void check_gltf_json(const nlohmann::json& document);

/// Whether an extension is supported.
[[nodiscard]] bool reads_gltf_extension(std::string_view name);

/// The feature that an unsupported extension adds to a surface, such as "sheen". Empty for extensions without which a
/// file cannot be shown.
[[nodiscard]] std::string_view gltf_layer(std::string_view name);

}  // namespace footprint
