// [environment] of a scene.toml, and the environment that it asks for; docs/scenes.md is its reference.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/scene/environment.hpp"

namespace footprint {

enum class EnvironmentKind { file, constant, sky };

/// What lights a scene from everywhere.
struct EnvironmentSettings {
  EnvironmentKind kind = EnvironmentKind::file;
  std::vector<std::filesystem::path> candidates;  ///< of a file: the first that exists
  std::string package;                            ///< Debian package that brings it, for the error text; may be empty
  SkySettings sky;
  glm::vec3 color{1.0F};  ///< of the constant
  double intensity = 1.0;
  double rotation_degrees = 0.0;  ///< about +y, counter-clockwise seen from above
};

class TomlTable;

/// The keys of an [environment] table.
[[nodiscard]] const std::vector<std::string>& environment_keys();

/// Relative paths start from `folder`. Errors (usage) read "FILE:LINE: ...".
[[nodiscard]] EnvironmentSettings read_environment(const TomlTable& table, const std::filesystem::path& folder);

/// Reads or computes it. Errors (usage): none of the files exists (the package is named); as load_environment.
[[nodiscard]] Environment make_environment(const EnvironmentSettings& settings, std::vector<std::string>& warnings);

}  // namespace footprint
