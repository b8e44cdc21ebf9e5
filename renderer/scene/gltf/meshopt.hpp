// Buffer views that a glTF file stores by meshoptimizer (EXT_meshopt_compression).
#pragma once

#include <tiny_gltf.h>

#include <nlohmann/json_fwd.hpp>

namespace footprint {

/// Gives a byte to buffers that stand for what is compressed and have none of their own, which tinygltf refuses; says
/// whether there are any. Of a checked document. Errors (usage): a buffer view in one that is not compressed; an image
/// in a compressed one.
[[nodiscard]] bool fill_fallback_buffers(nlohmann::json& document);

/// Decodes every compressed buffer view into a buffer of its own. Errors (usage) name the buffer view: the data is
/// damaged, lies outside its buffer, or has another size, mode or filter than the extension allows.
void decode_meshopt(tinygltf::Model& model);

}  // namespace footprint
