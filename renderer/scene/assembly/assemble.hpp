// Settings and model to a whole Scene: overrides, tiling, and the camera and lights that are missing.
#pragma once

#include <filesystem>
#include <string>

#include "renderer/scene/scene.hpp"
#include "renderer/scene/settings/scene.hpp"

namespace footprint {

/// Loads what `settings` names and completes it. `name` and `source` go into the scene. What is supplied is named in
/// Scene::defaults (docs/scenes.md). Errors (usage): no candidate file exists, whatever loading it refuses, a scene
/// without a triangle.
[[nodiscard]] Scene assemble_scene(const SceneSettings& settings, const std::string& name, const std::string& source);

}  // namespace footprint
