// Compressed geometry of glTF files: Draco (KHR_draco_mesh_compression) and meshoptimizer (EXT_meshopt_compression).
#pragma once

#include <tiny_gltf.h>

#include <nlohmann/json_fwd.hpp>

namespace footprint {

/// Adds a byte to fallback buffers of compressed data, because tinygltf refuses empty buffers. Returns whether there
/// are any. The document must be checked. Throws Error (usage): an uncompressed buffer view in such a buffer; an image
/// in a compressed one.
[[nodiscard]] bool fill_fallback_buffers(nlohmann::json& document);

/// Decodes every compressed buffer view into its own buffer. Throws Error (usage) that names the buffer view: damaged
/// data, data outside of its buffer, or an invalid size, mode or filter.
void decode_meshopt(tinygltf::Model& model);

/// Assigns the compressed data's buffer view to accessors of indices without one, which tinygltf refuses; decode_draco
/// replaces it. Returns whether there are any. The document must be checked.
[[nodiscard]] bool fill_draco_indices(nlohmann::json& document);

/// Decodes every compressed primitive into its own buffers and points its accessors there. Primitives with uncompressed
/// buffer views are not changed. Throws Error (usage) that names the primitive: damaged data, or counts, components or
/// types that differ from the accessors'.
void decode_draco(tinygltf::Model& model);

}  // namespace footprint
