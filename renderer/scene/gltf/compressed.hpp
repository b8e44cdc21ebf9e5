// Compressed geometry of glTF files: Draco (KHR_draco_mesh_compression) and meshoptimizer (EXT_meshopt_compression).
#pragma once

#include <tiny_gltf.h>

#include <nlohmann/json_fwd.hpp>

namespace footprint {

/// Gives a byte to buffers that stand for what is compressed and have none of their own, which tinygltf refuses; says
/// whether there are any. Of a checked document. Throws Error (usage): a buffer view in one that is not compressed; an
/// image in a compressed one.
[[nodiscard]] bool fill_fallback_buffers(nlohmann::json& document);

/// Decodes every compressed buffer view into a buffer of its own. Throws Error (usage) that names the buffer view: the
/// data is damaged, lies outside its buffer, or has another size, mode or filter than the extension allows.
void decode_meshopt(tinygltf::Model& model);

/// Gives the compressed data's buffer view to accessors of indices that have none, which tinygltf refuses; says whether
/// there are any. `decode_draco` gives them their own. Of a checked document.
[[nodiscard]] bool fill_draco_indices(nlohmann::json& document);

/// Decodes every compressed primitive into a buffer of its own and points its accessors there, so that they are read as
/// any other. A primitive whose accessors have buffer views of their own, uncompressed, is left as it is.
/// Throws Error (usage) that names the primitive: the data is damaged or no mesh, and counts, components or types that
/// are not those of the accessors.
void decode_draco(tinygltf::Model& model);

}  // namespace footprint
