// scene.toml as a plain value; docs/reference/scenes.md is its reference.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "renderer/core/toml_table.hpp"
#include "renderer/scene/camera.hpp"
#include "renderer/scene/environment.hpp"
#include "renderer/scene/scene.hpp"
#include "renderer/scene/settings/part.hpp"

namespace footprint {

enum class EnvironmentKind { file, constant, sky };

/// The light from all directions.
struct EnvironmentSettings {
  EnvironmentKind kind = EnvironmentKind::file;
  std::vector<std::filesystem::path> candidates;  ///< of a file: the first that exists
  std::string package;                            ///< Debian package that brings it, for the error text; may be empty
  SkySettings sky;
  glm::vec3 color{1.0F};  ///< of the constant
  double intensity = 1.0;
  double rotation_degrees = 0.0;  ///< about +y, counter-clockwise seen from above
};

/// Loads or computes the environment. Throws Error (usage): none of the files exists; as load_environment.
[[nodiscard]] Environment make_environment(const EnvironmentSettings& settings, std::vector<std::string>& warnings);

/// All of a scene.toml.
struct SceneSettings {
  Scene scene;                      ///< without what its parts, environment and camera add; the name may be empty
  std::string description;          ///< for lists of scenes
  std::vector<PartSettings> parts;  ///< at least one
  bool automatic_exposure = false;  ///< requested explicitly, also with the supplied lights
  std::vector<glm::dvec3> light_positions;  ///< of the lights of `scene`, in the user's coordinates
  bool keep_model_lights = true;
  bool supply_environment = false;  ///< with the supplied lights, if the scene has no light
  std::optional<EnvironmentSettings> environment;
  CameraSettings camera;
};

/// The keys of a [camera] table.
[[nodiscard]] const std::vector<std::string>& camera_keys();

/// Reads a [camera] table of a scene.toml or another file. Throws as read_scene_settings.
[[nodiscard]] CameraSettings read_camera(const TomlTable& table);

/// Reads a scene.toml. Relative paths in it start at its folder.
/// surfaces: those that it may name.
/// Throws Error (usage) "FILE:LINE: ...": not TOML, unknown keys with the nearest known one, wrong types, values out of
/// range, or settings that exclude each other.
[[nodiscard]] SceneSettings read_scene_settings(const std::filesystem::path& file, std::span<const Surface> surfaces);

}  // namespace footprint
