// See assemble.hpp.
#include "renderer/scene/assemble.hpp"

#include <fmt/format.h>

#include <array>
#include <memory>

#include "renderer/core/error.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/scene/camera.hpp"
#include "renderer/scene/gltf_model.hpp"
#include "renderer/scene/light_rig.hpp"
#include "renderer/scene/model.hpp"
#include "renderer/scene/plane.hpp"
#include "renderer/scene/surface_maps.hpp"

namespace footprint {
namespace {

Model load_content(const ModelSettings& settings) {
  for (const auto& candidate : settings.candidates) {
    std::error_code error;
    if (settings.candidates.size() > 1 && !std::filesystem::exists(candidate, error)) continue;
    try {
      return load_gltf(candidate);
    } catch (const Error& failed) {
      if (settings.package.empty() || std::filesystem::exists(candidate, error)) throw;
      throw Error(failed.kind(), failed.place(), failed.message(), "install the package " + settings.package);
    }
  }
  std::string tried;
  for (const auto& candidate : settings.candidates) tried += (tried.empty() ? "" : ", ") + candidate.string();
  throw Error(ErrorKind::usage, tried, "none of these files exists",
              settings.package.empty() ? "check the paths" : "install the package " + settings.package);
}

TextureMap make_map(const std::filesystem::path& file, Image image) {
  return {file.filename().string(), std::make_shared<const Image>(std::move(image)), {}};
}

Model load_content(const PlaneSettings& settings) {
  Model model;
  Material material;
  material.name = "plane";
  material.roughness = settings.roughness;
  material.metallic = settings.metallic;
  if (settings.normal_map) {
    const auto& file = *settings.normal_map;
    NormalMap map = decode_normal_map(read_image(file, Transfer::linear), settings.normal_scale);
    model.warnings = describe_faults(map, file.filename().string());
    material.normal_map = make_map(file, std::move(map.image));
  }
  if (settings.base_color_map) {
    const auto& file = *settings.base_color_map;
    material.base_color_map = make_map(file, to_rgba(read_image(file, Transfer::srgb)));
  }
  if (settings.metallic_roughness_map) {
    const auto& file = *settings.metallic_roughness_map;
    material.metallic_roughness_map = make_map(
        file, decode_metallic_roughness(read_image(file, Transfer::linear), settings.roughness, settings.metallic));
  }
  model.materials.push_back(std::move(material));
  model.meshes.push_back(make_plane(settings.size, {1.0F, 1.0F}));
  return model;
}

Model load_content(const SurfaceContent& content) {
  const auto& [surface, settings] = content;
  Material material;
  material.name = surface->name;
  material.roughness = 0.5F;
  material.metallic = 0.0F;
  material.normal_map = make_map(surface->name, surface_normals(*surface, settings));
  if (Image colors = surface_base_color(*surface, settings); !colors.empty()) {
    material.base_color_map = make_map(surface->name, std::move(colors));
  }
  Model model;
  model.materials.push_back(std::move(material));
  model.meshes.push_back(surface->mesh(settings));
  return model;
}

void apply(const BrdfSettings& settings, Material& material) {
  material.brdf.distribution = settings.distribution.value_or(material.brdf.distribution);
  material.brdf.geometry = settings.geometry.value_or(material.brdf.geometry);
  material.brdf.fresnel = settings.fresnel.value_or(material.brdf.fresnel);
  material.brdf.diffuse = settings.diffuse.value_or(material.brdf.diffuse);
  if (settings.base_color) {
    material.base_color = {*settings.base_color, material.base_color.a};
    // An alpha mask still needs the map's alpha: only its colour is replaced, by white.
    if (material.base_color_map && material.alpha_cutoff) {
      Image alpha_only = *material.base_color_map->image;
      for (std::size_t i = 0; i < alpha_only.texels.size(); ++i) {
        if (i % 4 != 3) alpha_only.texels[i] = 1.0F;
      }
      material.base_color_map->image = std::make_shared<const Image>(std::move(alpha_only));
    } else {
      material.base_color_map.reset();
    }
  }
  if (settings.lobe_parameter || settings.specular) material.metallic_roughness_map.reset();
  if (settings.lobe_parameter) material.lobe_parameter = settings.lobe_parameter;
  if (settings.specular) {
    material.dielectric_specular = *settings.specular;
    material.metallic = 0.0F;
  }
}

void tile(glm::vec2 tiling, Material& material) {
  for (auto* map : {&material.base_color_map, &material.metallic_roughness_map, &material.normal_map}) {
    if (!map->has_value()) continue;
    glm::mat3x2& transform = (*map)->coordinates.transform;
    for (int column = 0; column < 3; ++column) transform[column] *= tiling;
  }
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
  if (!scene.lights.empty() || scene.environment) return;
  scene.lights = supplied_lights(scene.camera, scene.bounds);
  scene.defaults.emplace_back("lights: a key and a fill directional light and a point light, white at radiance 0.8");
  if (!settings.exposure && !settings.automatic_exposure) {
    scene.exposure = 1.0F;
    scene.defaults.emplace_back("exposure: 1, which suits the supplied lights");
  }
}

}  // namespace

Scene assemble_scene(const SceneSettings& settings, const std::string& name, const std::string& source) {
  Model model = std::visit([](const auto& content) { return load_content(content); }, settings.content);
  if (model.meshes.empty()) {
    throw Error(ErrorKind::usage, source, "the scene has no triangle", "give it a mesh with at least one triangle");
  }
  Scene scene;
  scene.name = settings.name.value_or(name);
  scene.source = source;
  scene.meshes = std::move(model.meshes);
  scene.materials = std::move(model.materials);
  scene.warnings = std::move(model.warnings);
  for (Material& material : scene.materials) {
    apply(settings.brdf, material);
    tile(settings.tiling, material);
  }
  scene.bounds = bounds_of(scene.meshes);
  scene.frame_size = settings.frame_size;
  scene.distances = settings.distances;
  set_camera(settings, model.camera, scene);
  set_lights(settings, std::move(model.lights), scene);
  return scene;
}

}  // namespace footprint
