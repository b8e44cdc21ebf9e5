// A glTF file to a Model: scene selection, node hierarchy, and the warnings about what is left out.
#pragma once

#include <filesystem>

#include "renderer/scene/model.hpp"

namespace footprint {

/// Loads the file's default scene (else its first scene, else all root nodes): meshes in world space merged into one
/// per material, the materials in use, all lights, the first camera. May hold no triangle.
/// Errors (usage) name file and place; docs/scenes.md lists what is read.
[[nodiscard]] Model load_gltf(const std::filesystem::path& file);

}  // namespace footprint
