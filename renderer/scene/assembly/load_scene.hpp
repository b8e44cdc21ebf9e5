// From a scene folder, a scene.toml or a model file to a Scene.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "renderer/scene/model.hpp"
#include "renderer/scene/scene.hpp"
#include "renderer/scene/settings/part.hpp"
#include "renderer/scene/settings/scene.hpp"
#include "renderer/scene/surface.hpp"

namespace footprint {

/// Loads what `settings` names. May hold no triangle. Throws Error (usage): no candidate file exists, whatever loading
/// it refuses, lobes of another distribution than the surface's own.
[[nodiscard]] Model load_part(const PartSettings& settings);

/// A scene before it is assembled: its settings, which may be changed first.
struct SceneSource {
  SceneSettings settings;
  std::string name;            ///< that the scene gets where its settings give none
  std::string source;          ///< SCENE as it was given
  std::filesystem::path file;  ///< the settings' own; empty for a bare model
};

/// What stands in for a scene's own words.
struct SceneOverrides {
  CameraSettings camera;  ///< where it says anything
  ModelSelection model;   ///< of the scene's only model file; a camera of it goes before the scene's own
  std::optional<std::filesystem::path> environment;  ///< image instead of the scene's own environment
  std::optional<int> most_texels;  ///< per side, of surfaces that are made: those that ask for more have as many
};

/// What SCENE names, read but not assembled. Throws Error (usage) as of load_scene, but for those of assembling.
[[nodiscard]] SceneSource read_scene(const std::string& scene, const SceneLibrary& library,
                                     const SceneOverrides& overrides = {});

/// The scene of a source. Throws Error (usage) of assemble_scene, naming the file.
[[nodiscard]] Scene assemble(const SceneSource& source);

/// Loads SCENE as the command line takes it: a folder of `library.folder`, a folder with a scene.toml, a path to a
/// scene.toml, or a .gltf / .glb file (camera framed on its bounds and a light rig supplied where the file has none).
/// Throws Error (usage) that names file, place and hint; an unknown key in scene.toml names its line and the nearest
/// right key, and so does a surface that is not in the library; a selection of a scene without a model file, or with
/// several.
[[nodiscard]] Scene load_scene(const std::string& scene, const SceneLibrary& library,
                               const SceneOverrides& overrides = {});

/// Whether a path leads to something that load_scene takes: a folder with a scene.toml, a TOML file or a model file.
[[nodiscard]] bool is_scene(const std::filesystem::path& path);

/// The names of the folders in `scenes_folder` that hold a scene.toml, sorted.
[[nodiscard]] std::vector<std::string> list_scenes(const std::filesystem::path& scenes_folder);

/// The camera moved along its viewing direction so that its depth distance to the bounds' centre is `factor` times what
/// it is (orthographic: ymag scaled instead); near and far planes follow. `factor` > 0.
[[nodiscard]] Camera camera_at_distance(const Scene& scene, double factor);

}  // namespace footprint
