// What one model file gives to a scene, before scene.toml and the supplied camera and lights complete it.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "renderer/scene/model_selection.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {

/// Meshes, materials, lights and the camera of a model; the fields mean what they mean in Scene.
struct Model {
  std::vector<Mesh> meshes;
  std::vector<Material> materials;
  std::vector<Light> lights;
  std::optional<Camera> camera;
  std::vector<ModelChoice> choices;
  std::vector<std::string> warnings;
};

/// Adds a line that is not there yet: a thousand materials with one fault make one warning.
inline void add_once(std::vector<std::string>& lines, std::string line) {
  if (std::ranges::find(lines, line) == lines.end()) lines.push_back(std::move(line));
}

}  // namespace footprint
