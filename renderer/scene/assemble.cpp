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

TextureMap make_map(const std::filesystem::path& file, Image image, glm::vec2 uv = glm::vec2(1.0F)) {
  TextureMap map{file.filename().string(), std::make_shared<const Image>(std::move(image)), {}};
  map.coordinates.transform = {uv.x, 0.0F, 0.0F, uv.y, 0.0F, 0.0F};
  return map;
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

// Lobes in the parameter of one distribution.
bool has_own_lobes(const Material& material) { return material.lobe_parameter_map || !material.lobes.empty(); }

Model load_content(const SurfaceContent& content) {
  const auto& [surface, settings] = content;
  Material material;
  material.name = surface->name;
  material.roughness = 0.5F;
  material.metallic = 0.0F;
  material.normal_map = make_map(surface->name, surface_normals(*surface, settings));
  const glm::vec2 uv = surface->map_tiling != nullptr ? surface->map_tiling(settings) : glm::vec2(1.0F);
  const auto lay = [&](std::optional<TextureMap>& map, Image image) {
    if (!image.empty()) map = make_map(surface->name, std::move(image), uv);
  };
  lay(material.base_color_map, surface_base_color(*surface, settings));
  lay(material.specular_map, surface_specular(*surface, settings));
  if (material.specular_map) material.dielectric_specular = glm::vec3(1.0F);
  lay(material.lobe_parameter_map, surface_lobe_parameter(*surface, settings));
  if (surface->lobes != nullptr) material.lobes = surface->lobes(settings);
  if (has_own_lobes(material)) material.brdf.distribution = surface->distribution;
  Model model;
  model.materials.push_back(std::move(material));
  model.meshes.push_back(surface->mesh(settings));
  return model;
}

void replace_base_color(const glm::vec3& color, Material& material) {
  material.base_color = {color, material.base_color.a};
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

// What a material says of the width of its lobe, and which distribution it says it of.
void drop_width(std::optional<NormalDistribution> distribution, Material& material) {
  material.brdf.distribution = distribution.value_or(NormalDistribution::ggx);
  material.lobe_parameter.reset();
  material.lobes.clear();
  material.lobe_parameter_map.reset();
  material.metallic_roughness_map.reset();
}

void apply(const BrdfSettings& settings, const MapSettings& maps, Material& material) {
  if (settings.lobe_parameter || !settings.lobes.empty() || maps.lobe_parameter) {
    drop_width(settings.distribution, material);
    material.lobe_parameter = settings.lobe_parameter;
    material.lobes = settings.lobes;
  } else if (has_own_lobes(material) &&
             settings.distribution.value_or(material.brdf.distribution) != material.brdf.distribution) {
    throw Error(ErrorKind::usage, "[brdf] distribution",
                fmt::format("`{}` has lobes of its own, of another distribution", material.name),
                "leave the distribution out, or give lobes of it");
  }
  material.brdf.distribution = settings.distribution.value_or(material.brdf.distribution);
  material.brdf.geometry = settings.geometry.value_or(material.brdf.geometry);
  material.brdf.fresnel = settings.fresnel.value_or(material.brdf.fresnel);
  material.brdf.diffuse = settings.diffuse.value_or(material.brdf.diffuse);
  if (settings.base_color) replace_base_color(*settings.base_color, material);
  if (settings.specular) {
    material.metallic_roughness_map.reset();
    material.specular_map.reset();
    material.dielectric_specular = *settings.specular;
    material.metallic = 0.0F;
  }
}

void tile(glm::vec2 tiling, Material& material) {
  for (auto* map : {&material.base_color_map, &material.metallic_roughness_map, &material.normal_map,
                    &material.lobe_parameter_map, &material.specular_map}) {
    if (!map->has_value()) continue;
    glm::mat3x2& transform = (*map)->coordinates.transform;
    for (int column = 0; column < 3; ++column) transform[column] *= tiling;
  }
}

// Roughness beside a constant metalness, as Material::metallic_roughness_map has them.
Image with_metallic(const Image& roughness, float metallic) {
  Image map(roughness.width, roughness.height, 2, metallic);
  for (std::size_t i = 0; i < map.texel_count(); ++i) map.texels[2 * i] = roughness.texels[3 * i];
  return map;
}

Image read_lobe_parameter(const std::filesystem::path& file, NormalDistribution distribution) {
  const Image stored = read_image(file, Transfer::linear);
  if (!is_exr(file)) {
    throw Error(ErrorKind::usage, file.string(), "is no EXR, and no other format holds a lobe parameter",
                "store it as 32-bit floats in an EXR, or give a map of roughness");
  }
  const NumberRange range = lobe_range(distribution);
  try {
    return decode_lobe_parameter(stored, range.low, range.high);
  } catch (const Error& error) {
    throw error.within(file.string());
  }
}

// The maps of [maps], each over a whole material; read once and shared.
struct LaidMaps {
  std::optional<TextureMap> roughness, lobe_parameter, specular, diffuse;
};

LaidMaps load_maps(const SceneSettings& settings) {
  const auto load = [&](const std::optional<MapFile>& from, const auto& read) -> std::optional<TextureMap> {
    if (!from) return std::nullopt;
    return make_map(from->file, read(from->file), from->uv.value_or(settings.tiling));
  };
  const NormalDistribution distribution = settings.brdf.distribution.value_or(NormalDistribution::ggx);
  const auto read_colors = [](const auto& file) { return read_image(file, Transfer::srgb); };
  return {load(settings.maps.roughness, [](const auto& file) { return to_rgb(read_image(file, Transfer::linear)); }),
          load(settings.maps.lobe_parameter, [&](const auto& file) { return read_lobe_parameter(file, distribution); }),
          load(settings.maps.specular, [&](const auto& file) { return to_rgb(read_colors(file)); }),
          load(settings.maps.diffuse, [&](const auto& file) { return to_rgba(read_colors(file)); })};
}

void lay(const LaidMaps& maps, const BrdfSettings& settings, Material& material) {
  if (maps.specular) {
    material.metallic_roughness_map.reset();
    material.specular_map = maps.specular;
    material.dielectric_specular = settings.specular.value_or(glm::vec3(1.0F));
    material.metallic = 0.0F;
  }
  if (maps.lobe_parameter) material.lobe_parameter_map = maps.lobe_parameter;
  if (maps.roughness) {
    material.lobes.clear();
    material.lobe_parameter_map.reset();
    material.metallic_roughness_map = maps.roughness;
    material.metallic_roughness_map->image =
        std::make_shared<const Image>(with_metallic(*maps.roughness->image, material.metallic));
  }
  if (maps.diffuse) {
    material.base_color_map = maps.diffuse;
    material.base_color = {settings.base_color.value_or(glm::vec3(1.0F)), material.base_color.a};
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
  const LaidMaps maps = load_maps(settings);
  for (Material& material : scene.materials) {
    apply(settings.brdf, settings.maps, material);
    tile(settings.tiling, material);
    lay(maps, settings.brdf, material);
  }
  scene.bounds = bounds_of(scene.meshes);
  scene.frame_size = settings.frame_size;
  scene.distances = settings.distances;
  set_camera(settings, model.camera, scene);
  set_lights(settings, std::move(model.lights), scene);
  return scene;
}

}  // namespace footprint
