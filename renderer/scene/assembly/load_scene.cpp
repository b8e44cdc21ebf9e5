// Finds the file that a SCENE argument names, joins its parts, and adds missing cameras, lights and exposure.
#include "renderer/scene/assembly/load_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <span>
#include <string_view>
#include <system_error>

#include "renderer/core/error.hpp"
#include "renderer/core/names.hpp"
#include "renderer/scene/camera.hpp"
#include "renderer/scene/model.hpp"

namespace footprint {
namespace {

Bounds bounds_of(const std::vector<Mesh>& meshes) {
  Bounds bounds{meshes.front().vertices.front().position, meshes.front().vertices.front().position};
  for (const Mesh& mesh : meshes) {
    for (const Vertex& vertex : mesh.vertices) {
      bounds.lower = glm::min(bounds.lower, vertex.position);
      bounds.upper = glm::max(bounds.upper, vertex.position);
    }
  }
  return bounds;
}

/// Adds a part; the first camera is used.
void add(Model& model, Model part) {
  const int materials = static_cast<int>(model.materials.size());
  for (Mesh& mesh : part.meshes) mesh.material += materials;
  std::ranges::move(part.meshes, std::back_inserter(model.meshes));
  std::ranges::move(part.materials, std::back_inserter(model.materials));
  std::ranges::move(part.lights, std::back_inserter(model.lights));
  if (!model.camera) model.camera = part.camera;
  if (part.motion) {
    Motion& motion = model.motion ? *model.motion : model.motion.emplace();
    motion.last_key = std::max(motion.last_key, part.motion->last_key);
    motion.content = fnv1a(std::as_bytes(std::span(&part.motion->content, 1)), motion.content);
  }
  std::ranges::move(part.choices, std::back_inserter(model.choices));
  for (std::string& warning : part.warnings) add_once(model.warnings, std::move(warning));
}

// Materials of several parts may have the same name.
void tell_apart(std::vector<Material>& materials) {
  std::vector<std::string> names;
  for (const Material& material : materials) names.push_back(material.name);
  names = told_apart(std::move(names));
  for (std::size_t i = 0; i < materials.size(); ++i) materials[i].name = std::move(names[i]);
}

/// A part, before it is placed.
Model loaded_part(const PartSettings& part, std::size_t number, SceneFiles& files) {
  if (part.model) return load_part(part, files.models);
  const auto known = files.still_parts.find(number);
  if (known != files.still_parts.end()) return known->second;
  return files.still_parts.emplace(number, load_part(part, files.models)).first->second;
}

/// All parts, measured from one origin.
Model load_parts(const std::vector<PartSettings>& settings, const std::optional<PlacedBounds>& given,
                 SceneFiles& files) {
  std::vector<Model> parts;
  WideBounds bounds;
  for (const PartSettings& part : settings) {
    parts.push_back(loaded_part(part, parts.size(), files));
    bounds.add(placed_bounds(part.placement, parts.back()));
  }
  Model all;
  all.origin = given ? given->origin : origin_for(bounds, parts.front().origin);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    place(settings[i].placement, all.origin, parts[i]);
    add(all, std::move(parts[i]));
  }
  if (std::string warning = rounding_warning(bounds); !warning.empty()) add_once(all.warnings, std::move(warning));
  return all;
}

/// Facets of a patch shadow each other as on a flat surface, so that no light comes from below its plane.
void require_horizon(const SceneSettings& settings) {
  const auto patched = [](const PartSettings& part) { return !part.microgeometry.empty(); };
  if (settings.scene.horizon == Horizon::cut || std::ranges::none_of(settings.parts, patched)) return;
  throw Error(ErrorKind::usage, settings.scene.source,
              "its small-scale geometry knows no light from below the surface's horizon",
              "leave `horizon` out, or set it to \"cut\"");
}

void set_camera(const SceneSettings& settings, const std::optional<Camera>& own, Scene& scene) {
  if (const auto* placed = std::get_if<PlacedCamera>(&settings.camera)) {
    scene.camera = placed->lens;
    scene.camera.world = look_at(placed->position - scene.origin, placed->target - scene.origin, placed->up);
    return;
  }
  const auto* framing = std::get_if<Framing>(&settings.camera);
  if (framing == nullptr && own) {
    scene.camera = *own;
    return;
  }
  Framing used = framing != nullptr ? *framing : Framing{};
  if (scene.frame_size) used.aspect = static_cast<double>(scene.frame_size->x) / scene.frame_size->y;
  scene.camera = frame_bounds(scene.bounds, used);
  if (framing == nullptr) {
    scene.defaults.emplace_back("camera: framed on the bounds, seen from the front, slightly right and above");
  }
}

void set_environment(const EnvironmentSettings& settings, SceneFiles& files, Scene& scene) {
  if (!files.environment) files.environment = make_environment(settings, files.environment_warnings);
  scene.environment = files.environment;
  std::ranges::copy(files.environment_warnings, std::back_inserter(scene.warnings));
}

void set_lights(const SceneSettings& settings, const std::vector<Light>& own, SceneFiles& files, Scene& scene) {
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    if (glm::vec3* const position = position_in(scene.lights[i]))
      *position = glm::vec3(settings.light_positions[i] - scene.origin);
  }
  if (settings.keep_model_lights) scene.lights.insert(scene.lights.begin(), own.begin(), own.end());
  if (settings.environment) set_environment(*settings.environment, files, scene);
  if (!scene.lights.empty() || scene.environment) return;
  scene.lights = supplied_lights(scene.camera, scene.bounds);
  scene.defaults.emplace_back("lights: a key and a fill directional light and a point light, white at radiance 0.8");
  if (settings.supply_environment) {
    scene.environment = supplied_environment();
    scene.defaults.emplace_back("environment: a studio of soft light, so that metal has something to mirror");
  }
  if (!scene.exposure && !settings.automatic_exposure) {
    scene.exposure = 1.0F;
    scene.defaults.emplace_back("exposure: 1, which suits the supplied lights");
  }
}

Scene assemble_scene(const SceneSettings& settings, const std::optional<PlacedBounds>& bounds, SceneFiles& files) {
  Model model = load_parts(settings.parts, bounds, files);
  tell_apart(model.materials);
  Scene scene = settings.scene;
  if (model.meshes.empty()) {
    const std::string_view why = model.warnings.empty() ? "" : ": ";
    throw Error(ErrorKind::usage, scene.source,
                fmt::format("the scene has no triangle{}{}", why, fmt::join(model.warnings, "; ")),
                "give it a mesh with at least one triangle");
  }
  scene.meshes = std::move(model.meshes);
  scene.materials = std::move(model.materials);
  scene.choices = std::move(model.choices);
  scene.motion = model.motion;
  scene.warnings = std::move(model.warnings);
  scene.origin = model.origin;
  scene.bounds = bounds ? bounds->bounds : bounds_of(scene.meshes);
  require_horizon(settings);
  set_camera(settings, model.camera, scene);
  set_lights(settings, model.lights, files, scene);
  return scene;
}

namespace fs = std::filesystem;

constexpr const char* settings_name = "scene.toml";

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

// Applies a selection to the only model file.
void select(const ModelSelection& wanted, SceneSettings& settings) {
  if (wanted.empty()) return;
  std::vector<ModelSettings*> models;
  for (PartSettings& part : settings.parts) {
    if (part.model) models.push_back(&*part.model);
  }
  if (models.size() != 1) {
    throw Error(ErrorKind::usage, settings.scene.source,
                models.empty() ? "it has no model file whose scene, camera, variant, animation or time could be chosen"
                               : "it has several model files, so that it is not clear whose is chosen",
                models.empty() ? "leave the choice out"
                               : "write `scene`, `camera`, `variant`, `animation`, `time` into their [model] tables");
  }
  ModelSelection& own = models.front()->selection;
  if (wanted.scene) own.scene = wanted.scene;
  if (wanted.variant) own.variant = wanted.variant;
  if (wanted.animation) own.animation = wanted.animation;
  if (wanted.time) own.time = wanted.time;
  if (wanted.camera) {
    own.camera = wanted.camera;
    settings.camera = {};
  }
}

void apply(const SceneOverrides& overrides, SceneSource& source) {
  select(overrides.model, source.settings);
  if (!std::holds_alternative<std::monostate>(overrides.camera)) source.settings.camera = overrides.camera;
  if (overrides.environment) {
    source.settings.environment.emplace().candidates = {*overrides.environment};
  }
  source.bounds = overrides.bounds;
  for (PartSettings& part : source.settings.parts) {
    if (!part.surface || !overrides.most_texels) continue;
    int& resolution = part.surface->settings.resolution;
    resolution = std::min(resolution, *overrides.most_texels);
  }
}

SceneSource settings_source(const fs::path& file, std::span<const Surface> surfaces) {
  const std::string folder = fs::absolute(file).lexically_normal().parent_path().filename().string();
  SceneSource out{read_scene_settings(file, surfaces), file, {}};
  std::string& name = out.settings.scene.name;
  if (name.empty()) name = file.filename() == settings_name ? folder : file.stem().string();
  return out;
}

SceneSource bare_source(const fs::path& file) {
  SceneSource out;
  out.settings.scene.name = file.stem().string();
  out.settings.parts.emplace_back().model = ModelSettings{{file}, {}, false, {}};
  out.settings.scene.horizon = Horizon::open;
  out.settings.supply_environment = true;
  return out;
}

SceneSource source_of(const std::string& scene, const SceneLibrary& library) {
  if (scene.empty()) throw Error(ErrorKind::usage, "scene", "the name is empty", "name a scene or a glTF file");
  const fs::path path = scene;
  const bool plain_name = path == path.filename() && !path.has_extension();
  if (plain_name && is_file(library.folder / path / settings_name)) {
    return settings_source(library.folder / path / settings_name, library.surfaces);
  }
  std::error_code error;
  if (fs::is_directory(path, error)) {
    if (is_file(path / settings_name)) return settings_source(path / settings_name, library.surfaces);
    throw Error(ErrorKind::usage, scene, "the folder has no scene.toml", "name a folder with one, or a glTF file");
  }
  if (lower_extension(path) == ".toml") return settings_source(path, library.surfaces);
  if (names_model(path)) return bare_source(path);
  if (fs::exists(path, error)) {
    throw Error(ErrorKind::usage, scene, "is neither a scene.toml nor a .gltf, .glb or .obj file",
                "export the model as glTF 2.0");
  }
  throw Error(ErrorKind::usage, scene, "no such scene or file", suggestion(scene, list_scenes(library.folder)));
}

}  // namespace

SceneSource read_scene(const std::string& scene, const SceneLibrary& library, const SceneOverrides& overrides) {
  SceneSource source = source_of(scene, library);
  source.settings.scene.source = scene;
  apply(overrides, source);
  return source;
}

Scene assemble(const SceneSource& source, SceneFiles& files) {
  try {
    return assemble_scene(source.settings, source.bounds, files);
  } catch (const Error& error) {
    if (source.file.empty()) throw;
    throw error.within(source.file.string());
  }
}

Scene assemble(const SceneSource& source) {
  SceneFiles files;
  return assemble(source, files);
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
