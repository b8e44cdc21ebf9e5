// A glTF file to a Model: scene selection, node hierarchy, and the warnings about what is left out.
#pragma once

#include <filesystem>

#include "renderer/scene/model.hpp"

namespace footprint {

/// Loads a scene of the file: that of `selection`, else its default scene, its first one, or all root nodes. Meshes in
/// world space merged into one per material, the materials in use (of the variant that is asked for), all lights, one
/// camera: that of `selection`, else the first. May hold no triangle.
/// Errors (usage) name file and place; docs/scenes.md lists what is read.
[[nodiscard]] Model load_gltf(const std::filesystem::path& file, const ModelSelection& selection = {});

}  // namespace footprint
