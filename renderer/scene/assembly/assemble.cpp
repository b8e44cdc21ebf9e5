// Joins the parts to one model, then settles bounds, camera, lights and exposure, and notes what it had to supply.
#include "renderer/scene/assembly/assemble.hpp"

#include <algorithm>
#include <iterator>

#include "renderer/core/error.hpp"
#include "renderer/scene/assembly/load_part.hpp"
#include "renderer/scene/camera.hpp"
#include "renderer/scene/light_rig.hpp"
#include "renderer/scene/model.hpp"

namespace footprint {
namespace {

/// Adds a part to what is there; the first camera stays.
void add(Model& model, Model part) {
  const int materials = static_cast<int>(model.materials.size());
  for (Mesh& mesh : part.meshes) mesh.material += materials;
  std::ranges::move(part.meshes, std::back_inserter(model.meshes));
  std::ranges::move(part.materials, std::back_inserter(model.materials));
  std::ranges::move(part.lights, std::back_inserter(model.lights));
  if (!model.camera) model.camera = part.camera;
  std::ranges::move(part.choices, std::back_inserter(model.choices));
  for (std::string& warning : part.warnings) add_once(model.warnings, std::move(warning));
}

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

/// Facets of a patch shadow one another as if the surface were level, so that below its plane there is no light.
Horizon horizon_of(const SceneSettings& settings, const std::string& source) {
  const Horizon horizon = settings.horizon.value_or(Horizon::open);
  const auto patched = [](const PartSettings& part) { return !part.microgeometry.empty(); };
  if (horizon == Horizon::open && std::ranges::any_of(settings.parts, patched)) {
    throw Error(ErrorKind::usage, source, "its small-scale geometry knows no light from below the surface's horizon",
                "leave `horizon` out, or set it to \"cut\"");
  }
  return horizon;
}

void set_camera(const SceneSettings& settings, const std::optional<Camera>& own, Scene& scene) {
  if (const auto* placed = std::get_if<Camera>(&settings.camera)) {
    scene.camera = *placed;
    return;
  }
  const auto* framing = std::get_if<Framing>(&settings.camera);
  if (framing == nullptr && own) {
    scene.camera = *own;
    return;
  }
  Framing used = framing != nullptr ? *framing : Framing{};
  if (settings.frame_size) used.aspect = static_cast<double>(settings.frame_size->x) / settings.frame_size->y;
  scene.camera = frame_bounds(scene.bounds, used);
  if (framing == nullptr) {
    scene.defaults.emplace_back("camera: framed on the bounds, seen from the front, slightly right and above");
  }
}

void set_lights(const SceneSettings& settings, std::vector<Light> own, Scene& scene) {
  if (settings.keep_model_lights) scene.lights = std::move(own);
  scene.lights.insert(scene.lights.end(), settings.lights.begin(), settings.lights.end());
  if (settings.environment) scene.environment = make_environment(*settings.environment, scene.warnings);
  scene.exposure = settings.exposure;
  scene.footprint = settings.footprint;
  if (!scene.lights.empty() || scene.environment) return;
  scene.lights = supplied_lights(scene.camera, scene.bounds);
  scene.defaults.emplace_back("lights: a key and a fill directional light and a point light, white at radiance 0.8");
  if (settings.supply_environment) {
    scene.environment = supplied_environment();
    scene.defaults.emplace_back("environment: a studio of soft light, so that metal has something to mirror");
  }
  if (!settings.exposure && !settings.automatic_exposure) {
    scene.exposure = 1.0F;
    scene.defaults.emplace_back("exposure: 1, which suits the supplied lights");
  }
}

}  // namespace

Scene assemble_scene(const SceneSettings& settings, const std::string& name, const std::string& source) {
  Model model;
  for (const PartSettings& part : settings.parts) add(model, load_part(part));
  if (model.meshes.empty()) {
    throw Error(ErrorKind::usage, source, "the scene has no triangle", "give it a mesh with at least one triangle");
  }
  Scene scene;
  scene.name = settings.name.value_or(name);
  scene.source = source;
  scene.meshes = std::move(model.meshes);
  scene.materials = std::move(model.materials);
  scene.choices = std::move(model.choices);
  scene.warnings = std::move(model.warnings);
  scene.bounds = bounds_of(scene.meshes);
  scene.frame_size = settings.frame_size;
  scene.distances = settings.distances;
  scene.shadows = settings.shadows;
  scene.horizon = horizon_of(settings, source);
  set_camera(settings, model.camera, scene);
  set_lights(settings, std::move(model.lights), scene);
  return scene;
}

}  // namespace footprint
