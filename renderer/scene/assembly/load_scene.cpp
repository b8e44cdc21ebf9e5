// Tells what a SCENE argument names: a scene of the library, a folder, a .toml file or a model file.
#include "renderer/scene/assembly/load_scene.hpp"

#include <algorithm>
#include <system_error>

#include "renderer/core/error.hpp"
#include "renderer/core/suggest.hpp"
#include "renderer/scene/assembly/assemble.hpp"
#include "renderer/scene/model_file.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

constexpr const char* settings_name = "scene.toml";

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

// `camera` in place of the settings' own, where it says anything.
void replace_camera(SceneSettings& settings, const CameraSettings& camera) {
  if (!std::holds_alternative<std::monostate>(camera)) settings.camera = camera;
}

SceneSource settings_source(const fs::path& file, const std::string& source, std::span<const Surface> surfaces,
                            const CameraSettings& camera) {
  const std::string folder = fs::absolute(file).lexically_normal().parent_path().filename().string();
  const std::string stem = file.filename() == settings_name ? folder : file.stem().string();
  SceneSource out{read_scene_settings(file, surfaces), stem, source, file};
  replace_camera(out.settings, camera);
  return out;
}

SceneSource bare_source(const fs::path& file, const std::string& source, const CameraSettings& camera) {
  SceneSource out{{}, file.stem().string(), source, {}};
  replace_camera(out.settings, camera);
  out.settings.parts.emplace_back().content = ModelSettings{{file}, {}, false};
  return out;
}

}  // namespace

SceneSource read_scene(const std::string& scene, const SceneLibrary& library, const CameraSettings& camera) {
  if (scene.empty()) throw Error(ErrorKind::usage, "scene", "the name is empty", "name a scene or a glTF file");
  const fs::path path = scene;
  const bool plain_name = path == path.filename() && !path.has_extension();
  if (plain_name && is_file(library.folder / path / settings_name)) {
    return settings_source(library.folder / path / settings_name, scene, library.surfaces, camera);
  }
  std::error_code error;
  if (fs::is_directory(path, error)) {
    if (is_file(path / settings_name)) return settings_source(path / settings_name, scene, library.surfaces, camera);
    throw Error(ErrorKind::usage, scene, "the folder has no scene.toml", "name a folder with one, or a glTF file");
  }
  if (lower_extension(path) == ".toml") return settings_source(path, scene, library.surfaces, camera);
  if (names_model(path)) return bare_source(path, scene, camera);
  if (fs::exists(path, error)) {
    throw Error(ErrorKind::usage, scene, "is neither a scene.toml nor a .gltf, .glb or .obj file",
                "export the model as glTF 2.0");
  }
  throw Error(ErrorKind::usage, scene, "no such scene or file", suggestion(scene, list_scenes(library.folder)));
}

Scene assemble(const SceneSource& source) {
  try {
    return assemble_scene(source.settings, source.name, source.source);
  } catch (const Error& error) {
    if (source.file.empty()) throw;
    throw error.within(source.file.string());
  }
}

Scene load_scene(const std::string& scene, const SceneLibrary& library, const CameraSettings& camera) {
  return assemble(read_scene(scene, library, camera));
}

std::vector<std::string> list_scenes(const fs::path& scenes_folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(scenes_folder, error), end; entry != end; entry.increment(error)) {
    if (is_file(entry->path() / settings_name)) names.push_back(entry->path().filename().string());
  }
  std::ranges::sort(names);
  return names;
}

}  // namespace footprint
