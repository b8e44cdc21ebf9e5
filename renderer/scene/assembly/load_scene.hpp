// From a scene folder, a scene.toml or a model file to a Scene.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "renderer/scene/model.hpp"
#include "renderer/scene/origin.hpp"
#include "renderer/scene/scene.hpp"
#include "renderer/scene/settings/part.hpp"
#include "renderer/scene/settings/scene.hpp"
#include "renderer/scene/surface.hpp"

namespace footprint {

/// Loads a part of a scene, before it is placed. It may have no triangles. Throws Error (usage): no candidate file
/// exists, errors of its files, lobes of another distribution than the surface's own.
[[nodiscard]] Model load_part(const PartSettings& settings, ModelFiles& files);

/// The bounds of a model once it is placed. Empty without a vertex.
[[nodiscard]] WideBounds placed_bounds(const Placement& placement, const Model& model);

/// Moves a model with its lights and its camera, whose strengths and angles stay.
/// origin: what its positions are measured from afterwards.
void place(const Placement& placement, const glm::dvec3& origin, Model& model);

/// What the poses of an animation share, so that cameras and lights without a place of their own stay.
struct PlacedBounds {
  Bounds bounds;
  glm::dvec3 origin{0.0};  ///< as Scene::origin
};

/// The settings of a scene before it is assembled, which may still be changed.
struct SceneSource {
  SceneSettings settings{};
  std::filesystem::path file{};          ///< of the settings; empty for a bare model
  std::optional<PlacedBounds> bounds{};  ///< none: those of its meshes
};

/// Overrides of a scene's settings.
struct SceneOverrides {
  CameraSettings camera;  ///< unless it is empty
  ModelSelection model;   ///< in the scene's only model file; its camera overrides the scene's
  std::optional<std::filesystem::path> environment;  ///< image that replaces the scene's environment
  std::optional<int> most_texels;                    ///< largest texels per side of generated surfaces
  std::optional<PlacedBounds>
      bounds;  ///< what cameras and lights without a place of their own go by; none: those of its meshes
};

/// Reads the settings of SCENE. Throws as load_scene, except errors of assembling.
[[nodiscard]] SceneSource read_scene(const std::string& scene, const SceneLibrary& library,
                                     const SceneOverrides& overrides = {});

/// What a scene was assembled from, to assemble it again at another time of its animation.
struct SceneFiles {
  ModelFiles models;
  std::map<std::size_t, Model> still_parts = {};  ///< without a model file, by their number; not placed
  std::optional<Environment> environment = {};
  std::vector<std::string> environment_warnings = {};
};

/// Assembles the scene. Throws errors of its files, which name the settings' file.
/// files: of a source that differs in times alone, or new ones; what they have is not read again.
[[nodiscard]] Scene assemble(const SceneSource& source, SceneFiles& files);
[[nodiscard]] Scene assemble(const SceneSource& source);

/// Loads a scene.
/// scene: a folder of `library.folder`, a folder with a scene.toml, a scene.toml, or a .gltf, .glb or .obj file. A bare
/// model without camera or lights gets a camera framed on its bounds and a light rig.
/// Throws Error (usage) with file, place and hint: errors of the files; an unknown key or surface, with its line and
/// the nearest known one; a selection if the scene has not exactly one model file.
[[nodiscard]] Scene load_scene(const std::string& scene, const SceneLibrary& library,
                               const SceneOverrides& overrides = {});

/// Whether load_scene accepts a path: a folder with a scene.toml, a TOML file or a model file.
[[nodiscard]] bool is_scene(const std::filesystem::path& path);

/// The sorted names of the folders in `scenes_folder` with a scene.toml.
[[nodiscard]] std::vector<std::string> list_scenes(const std::filesystem::path& scenes_folder);

/// The camera moved along its viewing direction so that its depth distance to the bounds' centre is multiplied by
/// `factor`, above 0; for orthographic cameras ymag is. Near and far planes follow.
[[nodiscard]] Camera camera_at_distance(const Scene& scene, double factor);

}  // namespace footprint
