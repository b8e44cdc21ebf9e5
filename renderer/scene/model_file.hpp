// Model files of every format that is read, told apart by their endings.
#pragma once

#include <filesystem>

#include "renderer/scene/model.hpp"

namespace footprint {

/// Whether a path ends as a model file does: .gltf, .glb or .obj.
[[nodiscard]] bool names_model(const std::filesystem::path& path);

/// Loads an .obj file as such, any other as glTF. Errors (usage): as of load_obj and load_gltf; a selection of an .obj
/// file, which holds one thing alone.
[[nodiscard]] Model load_model(const std::filesystem::path& file, const ModelSelection& selection = {});

}  // namespace footprint
