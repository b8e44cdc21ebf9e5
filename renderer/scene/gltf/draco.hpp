// Geometry that a glTF file stores by Draco (KHR_draco_mesh_compression).
#pragma once

#include <tiny_gltf.h>

#include <nlohmann/json_fwd.hpp>

namespace footprint {

/// Gives the compressed data's buffer view to accessors of indices that have none, which tinygltf refuses; says whether
/// there are any. `decode_draco` gives them their own. Of a checked document.
[[nodiscard]] bool fill_draco_indices(nlohmann::json& document);

/// Decodes every compressed primitive into a buffer of its own and points its accessors there, so that they are read as
/// any other. A primitive whose accessors have buffer views of their own, uncompressed, is left as it is.
/// Errors (usage) name the primitive: the data is damaged or no mesh, and counts, components or types that are not
/// those of the accessors.
void decode_draco(tinygltf::Model& model);

}  // namespace footprint
