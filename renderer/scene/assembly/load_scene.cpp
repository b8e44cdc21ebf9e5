// Tells what a SCENE argument names: a scene of the library, a folder, a .toml file or a model file.
#include "renderer/scene/assembly/load_scene.hpp"

#include <algorithm>
#include <system_error>

#include "renderer/core/error.hpp"
#include "renderer/core/file_names.hpp"
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

ModelSettings* model_of(PartSettings& part) {
  if (auto* dressed = std::get_if<DressedModel>(&part.content)) return &dressed->model;
  return std::get_if<ModelSettings>(&part.content);
}

SurfaceContent* surface_of(PartSettings& part) {
  if (auto* dressed = std::get_if<DressedModel>(&part.content)) return &dressed->surface;
  return std::get_if<SurfaceContent>(&part.content);
}

void limit_surfaces(int most_texels, SceneSettings& settings) {
  for (PartSettings& part : settings.parts) {
    if (SurfaceContent* surface = surface_of(part))
      surface->settings.resolution = std::min(surface->settings.resolution, most_texels);
  }
}

// What is asked for of the only model file.
void select(const ModelSelection& wanted, const std::string& source, SceneSettings& settings) {
  if (wanted.empty()) return;
  std::vector<ModelSettings*> models;
  for (PartSettings& part : settings.parts) {
    if (ModelSettings* model = model_of(part)) models.push_back(model);
  }
  if (models.size() != 1) {
    throw Error(
        ErrorKind::usage, source,
        models.empty() ? "it has no model file whose scene, camera or variant could be chosen"
                       : "it has several model files, so that it is not clear whose is chosen",
        models.empty() ? "leave the choice out" : "write `scene`, `camera`, `variant` into their [model] tables");
  }
  ModelSelection& own = models.front()->selection;
  if (wanted.scene) own.scene = wanted.scene;
  if (wanted.variant) own.variant = wanted.variant;
  if (wanted.camera) {
    own.camera = wanted.camera;
    settings.camera = {};
  }
}

void apply(const SceneOverrides& overrides, SceneSource& source) {
  select(overrides.model, source.source, source.settings);
  if (!std::holds_alternative<std::monostate>(overrides.camera)) source.settings.camera = overrides.camera;
  if (overrides.environment) {
    source.settings.environment.emplace().candidates = {*overrides.environment};
  }
  if (overrides.most_texels) limit_surfaces(*overrides.most_texels, source.settings);
}

SceneSource settings_source(const fs::path& file, const std::string& source, std::span<const Surface> surfaces) {
  const std::string folder = fs::absolute(file).lexically_normal().parent_path().filename().string();
  const std::string stem = file.filename() == settings_name ? folder : file.stem().string();
  return {read_scene_settings(file, surfaces), stem, source, file};
}

SceneSource bare_source(const fs::path& file, const std::string& source) {
  SceneSource out{{}, file.stem().string(), source, {}};
  out.settings.parts.emplace_back().content = ModelSettings{{file}, {}, false, {}};
  out.settings.supply_environment = true;
  return out;
}

SceneSource source_of(const std::string& scene, const SceneLibrary& library) {
  if (scene.empty()) throw Error(ErrorKind::usage, "scene", "the name is empty", "name a scene or a glTF file");
  const fs::path path = scene;
  const bool plain_name = path == path.filename() && !path.has_extension();
  if (plain_name && is_file(library.folder / path / settings_name)) {
    return settings_source(library.folder / path / settings_name, scene, library.surfaces);
  }
  std::error_code error;
  if (fs::is_directory(path, error)) {
    if (is_file(path / settings_name)) return settings_source(path / settings_name, scene, library.surfaces);
    throw Error(ErrorKind::usage, scene, "the folder has no scene.toml", "name a folder with one, or a glTF file");
  }
  if (lower_extension(path) == ".toml") return settings_source(path, scene, library.surfaces);
  if (names_model(path)) return bare_source(path, scene);
  if (fs::exists(path, error)) {
    throw Error(ErrorKind::usage, scene, "is neither a scene.toml nor a .gltf, .glb or .obj file",
                "export the model as glTF 2.0");
  }
  throw Error(ErrorKind::usage, scene, "no such scene or file", suggestion(scene, list_scenes(library.folder)));
}

}  // namespace

SceneSource read_scene(const std::string& scene, const SceneLibrary& library, const SceneOverrides& overrides) {
  SceneSource source = source_of(scene, library);
  apply(overrides, source);
  return source;
}

Scene assemble(const SceneSource& source) {
  try {
    return assemble_scene(source.settings, source.name, source.source);
  } catch (const Error& error) {
    if (source.file.empty()) throw;
    throw error.within(source.file.string());
  }
}

Scene load_scene(const std::string& scene, const SceneLibrary& library, const SceneOverrides& overrides) {
  return assemble(read_scene(scene, library, overrides));
}

bool is_scene(const fs::path& path) {
  if (is_file(path)) return lower_extension(path) == ".toml" || names_model(path);
  return is_file(path / settings_name);
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
