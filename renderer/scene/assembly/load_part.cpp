// Loads a part's content, lays BRDF, patches, layer and maps over each of its materials, then moves it into the world.
#include "renderer/scene/assembly/load_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>

#include "renderer/core/error.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/scene/assembly/anisotropy_map.hpp"
#include "renderer/scene/assembly/microgeometry_content.hpp"
#include "renderer/scene/assembly/surface_maps.hpp"
#include "renderer/scene/charts.hpp"
#include "renderer/scene/geometry.hpp"
#include "renderer/scene/model.hpp"
#include "renderer/scene/origin.hpp"
#include "renderer/scene/settings/toml_values.hpp"

namespace footprint {
namespace {

Model load_file(const ModelSettings& settings, ModelFiles& files) {
  for (const auto& candidate : settings.candidates) {
    std::error_code error;
    if (settings.candidates.size() > 1 && !std::filesystem::exists(candidate, error)) continue;
    try {
      return files.load(candidate, settings.selection);
    } catch (const Error& failed) {
      if (settings.package.empty() || std::filesystem::exists(candidate, error)) throw;
      throw Error(failed.kind(), failed.place(), failed.message(), "install the package " + settings.package);
    }
  }
  throw missing_candidates(settings.candidates, "none of these files exists", settings.package, "check the paths");
}

MapTexels computed(Image image) { return std::make_shared<const Image>(std::move(image)); }

TextureMap make_map(const std::filesystem::path& file, MapTexels texels, glm::vec2 uv = glm::vec2(1.0F)) {
  TextureMap map{file.filename().string(), std::move(texels), {}};
  map.coordinates.transform = {uv.x, 0.0F, 0.0F, uv.y, 0.0F, 0.0F};
  return map;
}

TextureMap make_map(const NormalFile& file, std::vector<std::string>& warnings, glm::vec2 uv = glm::vec2(1.0F)) {
  TextureMap map = make_map(file.path, read_normals(file, warnings), uv);
  if (file.heights) map.coordinates.wrap = file.heights->wrap;
  return map;
}

Model load_plane(const PlaneSettings& settings) {
  Model model;
  Material material;
  material.name = "plane";
  material.roughness = settings.roughness;
  material.metallic = settings.metallic;
  if (settings.normals) material.normal_map = make_map(*settings.normals, model.warnings);
  if (settings.base_color_map) {
    const auto& file = *settings.base_color_map;
    material.base_color_map =
        make_map(file, MapTexels::packed(to_rgba(read_unit_map(file, Transfer::srgb, color_channels, model.warnings))));
  }
  if (settings.metallic_roughness_map) {
    const auto& file = *settings.metallic_roughness_map;
    material.metallic_roughness_map =
        make_map(file, MapTexels::packed(decode_metallic_roughness(
                           read_unit_map(file, Transfer::linear, roughness_channels, model.warnings),
                           settings.roughness, settings.metallic)));
  }
  model.materials.push_back(std::move(material));
  model.meshes.push_back(make_plane(settings.size, {1.0F, 1.0F}));
  return model;
}

// Lobes in the parameter of one distribution.
bool has_own_lobes(const Material& material) { return material.lobe_parameter_map || !material.lobes.empty(); }

Material surface_material(const SurfaceContent& content) {
  const Surface& surface = *content.surface;
  const SurfaceSettings& settings = content.settings;
  Material material;
  material.name = surface.name;
  material.roughness = 0.5F;
  material.metallic = 0.0F;
  material.normal_map = make_map(surface.name, computed(surface_normals(surface, settings)));
  const glm::vec2 uv = surface.map_tiling != nullptr ? surface.map_tiling(settings) : glm::vec2(1.0F);
  const auto lay = [&](std::optional<TextureMap>& map, Image image) {
    if (!image.empty()) map = make_map(surface.name, computed(std::move(image)), uv);
  };
  lay(material.base_color_map, surface_map(surface, settings, &Surface::base_color));
  lay(material.specular_map, surface_map(surface, settings, &Surface::specular));
  if (material.specular_map) material.dielectric_specular = glm::vec3(1.0F);
  lay(material.lobe_parameter_map, surface_map(surface, settings, &Surface::lobe_parameter));
  if (surface.lobes != nullptr) material.lobes = surface.lobes(settings);
  if (has_own_lobes(material)) material.brdf.distribution = surface.distribution;
  return material;
}

/// The model's triangles as one mesh.
Mesh merged(std::vector<Mesh> meshes) {
  Mesh all = std::move(meshes.front());
  for (std::size_t i = 1; i < meshes.size(); ++i) append(all, meshes[i]);
  all.material = 0;
  for (Vertex& vertex : all.vertices) vertex.color = glm::vec4(1.0F);  // of the materials that are replaced
  return all;
}

Model load_content(const PartSettings& part, ModelFiles& files) {
  if (part.plane) return load_plane(*part.plane);
  Model model;
  if (part.model) model = load_file(*part.model, files);
  if (part.surface) {
    if (!part.model) model.meshes.push_back(part.surface->surface->mesh(part.surface->settings));
    if (!model.meshes.empty()) model.meshes = {merged(std::move(model.meshes))};
    model.materials = {surface_material(*part.surface)};
  }
  if (part.model && part.model->unwrap) std::ranges::for_each(model.meshes, unwrap);
  return model;
}

TextureMap load_layer(const LayerSettings& settings, std::vector<std::string>& warnings) {
  if (const auto* file = std::get_if<NormalFile>(&settings.content)) return make_map(*file, warnings, settings.uv);
  const auto& [surface, surface_settings] = std::get<SurfaceContent>(settings.content);
  Image normals = surface_normals(*surface, surface_settings);
  scale_slopes(normals, settings.strength);
  return make_map(surface->name, computed(std::move(normals)), settings.uv);
}

void replace_base_color(const glm::vec3& color, Material& material) {
  material.base_color = {color, material.base_color.a};
  // An alpha mask still needs the map's alpha: only its colour is replaced, by white.
  if (material.base_color_map && material.alpha_cutoff) {
    Image alpha_only = material.base_color_map->image.decoded();
    for (std::size_t i = 0; i < alpha_only.texels.size(); ++i) {
      if (i % 4 != 3) alpha_only.texels[i] = 1.0F;
    }
    material.base_color_map->image = MapTexels::packed(alpha_only);
  } else {
    material.base_color_map.reset();
  }
}

// Vertex colours would multiply the replaced base colour; their alpha still cuts out.
void whiten_vertices(Model& model) {
  for (Mesh& mesh : model.meshes) {
    for (Vertex& vertex : mesh.vertices) vertex.color = {1.0F, 1.0F, 1.0F, vertex.color.a};
  }
}

// Removes the width and the distribution of a material's lobe.
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
  if (settings.anisotropy) {
    material.anisotropy = settings.anisotropy;
    material.anisotropy_map.reset();
  }
  if (settings.base_color) replace_base_color(*settings.base_color, material);
  if (settings.specular) {
    material.metallic_roughness_map.reset();
    material.specular_map.reset();
    material.dielectric_specular = *settings.specular;
    material.metallic = 0.0F;
  }
}

void tile(glm::vec2 tiling, Material& material) {
  for (TextureMap* map : maps_of(material)) {
    glm::mat3x2& transform = map->coordinates.transform;
    for (int column = 0; column < 3; ++column) transform[column] *= tiling;
  }
}

// Roughness beside a constant metalness, as Material::metallic_roughness_map has them.
Image with_metallic(const Image& roughness, float metallic) {
  return mapped(
      roughness, 2, [](const auto& in, const auto& out) { out[0] = in[0]; }, metallic);
}

Image read_lobe_parameter(const std::filesystem::path& file, NormalDistribution distribution,
                          std::vector<std::string>& warnings) {
  const FileImage stored = read_file_image(file, Transfer::linear);
  if (!is_exr(file)) {
    throw Error(ErrorKind::usage, file.string(), "is not an EXR, and no other format can store a lobe parameter",
                "store it as 32-bit floats in an EXR, or give a map of roughness");
  }
  const NumberRange range = lobe_range(distribution);
  try {
    for (std::string& line :
         describe_file(stored, first_channel_alone, fmt::format("map `{}`", file.filename().string())))
      warnings.push_back(std::move(line));
    return decode_lobe_parameter(stored.image, range.low, range.high);
  } catch (const Error& error) {
    throw error.within(file.string());
  }
}

// Lays the maps over each material; all share their texels.
void lay_maps(const PartSettings& settings, Model& model) {
  const MapSettings& maps = settings.maps;
  const auto lay = [&](const std::optional<MapFile>& from, const auto& read, const auto& lay_over) {
    if (!from) return;
    const TextureMap map =
        make_map(from->file, MapTexels::packed(read(from->file)), from->uv.value_or(settings.tiling));
    for (Material& material : model.materials) lay_over(map, material);
  };
  const auto read_rgb = [&](const auto& file) {
    return to_rgb(read_unit_map(file, Transfer::srgb, color_channels, model.warnings));
  };
  lay(maps.specular, read_rgb, [&](const TextureMap& map, Material& material) {
    material.metallic_roughness_map.reset();
    material.specular_map = map;
    material.dielectric_specular = settings.brdf.specular.value_or(glm::vec3(1.0F));
    material.metallic = 0.0F;
  });
  if (maps.normals) {
    const TextureMap map = make_map(*maps.normals, model.warnings, maps.normals->uv.value_or(settings.tiling));
    for (Material& material : model.materials) material.normal_map = map;
  }
  const NormalDistribution distribution = settings.brdf.distribution.value_or(NormalDistribution::ggx);
  lay(
      maps.lobe_parameter, [&](const auto& file) { return read_lobe_parameter(file, distribution, model.warnings); },
      [](const TextureMap& map, Material& material) { material.lobe_parameter_map = map; });
  const auto read_roughness = [&](const auto& file) {
    return to_rgb(read_unit_map(file, Transfer::linear, first_channel_alone, model.warnings));
  };
  lay(maps.roughness, read_roughness, [](const TextureMap& map, Material& material) {
    material.lobes.clear();
    material.lobe_parameter_map.reset();
    material.metallic_roughness_map = map;
    material.metallic_roughness_map->image = MapTexels::packed(with_metallic(map.image.decoded(), material.metallic));
  });
  lay(
      maps.normal_kappa,
      [&](const auto& file) { return read_lobe_parameter(file, NormalDistribution::vmf, model.warnings); },
      spread_normals);
  const auto read_rgba = [&](const auto& file) {
    return to_rgba(read_unit_map(file, Transfer::srgb, color_channels, model.warnings));
  };
  lay(maps.diffuse, read_rgba, [&](const TextureMap& map, Material& material) {
    material.base_color_map = map;
    material.base_color = {settings.brdf.base_color.value_or(glm::vec3(1.0F)), material.base_color.a};
  });
}

std::optional<ClearCoat> load_coat(const CoatSettings& settings, std::vector<std::string>& warnings) {
  if (settings.weight == 0.0F) return std::nullopt;
  ClearCoat coat;
  coat.weight = settings.weight;
  coat.roughness = settings.roughness;
  if (settings.normals) coat.normal_map = make_map(*settings.normals, warnings);
  return coat;
}

// The shares of several materials of a surface. 8-bit images store indices in the 255 steps of the red channel.
std::vector<TextureMap> load_shares(const MapFile& from, glm::vec2 tiling, std::size_t count) {
  Image stored = read_image(from.file, Transfer::linear);
  if (!is_exr(from.file)) {
    for (float& value : stored.texels) value *= 255.0F;
  }
  std::vector<TextureMap> shares;
  try {
    for (const Image& share : decode_indices(stored, count)) {
      shares.push_back(make_map(from.file, MapTexels::packed(share), from.uv.value_or(tiling)));
    }
  } catch (const Error& error) {
    throw error.within(from.file.string());
  }
  return shares;
}

// Gives a model its patches. Of several each material gets one copy for each, and each mesh one for each of those: the
// copies of a material follow one another.
void lay_patches(const PartSettings& settings, Model& model) {
  const std::size_t count = settings.microgeometry.size();
  std::vector<MicrogeometryContent> patches;
  for (const MicrogeometrySettings& patch : settings.microgeometry) patches.push_back(load_microgeometry(patch));
  if (count == 1) {
    for (Material& material : model.materials) apply(patches.front(), material);
  }
  if (count < 2) return;
  const std::vector<TextureMap> shares = load_shares(*settings.maps.material, settings.tiling, count);
  std::vector<Material> materials;
  for (const Material& material : model.materials) {
    for (std::size_t k = 0; k < count; ++k) {
      Material& copy = materials.emplace_back(material);
      copy.name += fmt::format("/{}", k);
      copy.share = SurfaceShare{shares[k], k == 0};
      apply(patches[k], copy);
    }
  }
  std::vector<Mesh> meshes;
  for (const Mesh& mesh : model.meshes) {
    for (std::size_t k = 0; k < count; ++k)
      meshes.emplace_back(mesh).material = mesh.material * static_cast<int>(count) + static_cast<int>(k);
  }
  model.materials = std::move(materials);
  model.meshes = std::move(meshes);
}

// Moves points by a placement, in double precision.
class Placer {
 public:
  // origin: what the points are measured from.
  Placer(const Placement& placement, const glm::dvec3& origin) : placement_(placement), origin_(origin) {
    glm::dmat4 turn{1.0};
    for (int axis = 2; axis >= 0; --axis) {  // the last factor turns first
      glm::dvec3 about{0.0};
      about[axis] = 1.0;
      turn = glm::rotate(turn, placement.rotation[axis], about);
    }
    rotation_ = glm::dmat3(turn);
  }

  // In the user's coordinates.
  [[nodiscard]] glm::dvec3 point(const glm::vec3& point) const {
    return rotation_ * (placement_.scale * (glm::dvec3(point) + origin_)) + placement_.translation;
  }
  [[nodiscard]] const glm::dmat3& rotation() const { return rotation_; }

 private:
  const Placement& placement_;
  glm::dvec3 origin_;
  glm::dmat3 rotation_{1.0};
};

// Turns normals, tangents, and the directions of lights and camera.
void turn_directions(const glm::dmat3& rotation, Model& model) {
  const auto turned = [&](const glm::vec3& direction) { return glm::vec3(rotation * glm::dvec3(direction)); };
  for (Mesh& mesh : model.meshes) {
    for (Vertex& vertex : mesh.vertices) {
      vertex.normal = turned(vertex.normal);
      vertex.tangent = {turned(glm::vec3(vertex.tangent)), vertex.tangent.w};
    }
  }
  for (Light& light : model.lights) {
    if (auto* directional = std::get_if<DirectionalLight>(&light))
      directional->direction = turned(directional->direction);
    if (auto* spot = std::get_if<SpotLight>(&light)) spot->direction = turned(spot->direction);
  }
  if (!model.camera) return;
  for (int axis = 0; axis < 3; ++axis) model.camera->world[axis] = {turned(glm::vec3(model.camera->world[axis])), 0.0F};
}

void add_name(const std::string& part, std::string& name) {
  if (!part.empty()) name = name.empty() ? part : part + "/" + name;
}

// Takes an anisotropy of strength 0 away, and refuses one that a model has where its lobe cannot be stretched.
void settle_anisotropy(Material& material, std::vector<std::string>& warnings) {
  lay_anisotropy(material, warnings);
  if (material.anisotropy && material.anisotropy->strength == 0.0F && !material.anisotropy_map)
    material.anisotropy.reset();
  if (!material.anisotropy) return;
  const NormalDistribution distribution = material.brdf.distribution;
  const bool stretchable = distribution == NormalDistribution::ggx || distribution == NormalDistribution::beckmann;
  if (stretchable && material.lobes.empty() && !material.microgeometry) return;
  throw Error(ErrorKind::usage, "[brdf] anisotropy",
              fmt::format("`{}` is anisotropic, which needs the distribution ggx, beckmann or ward, one lobe per facet "
                          "and no [microgeometry]",
                          material.name),
              "give anisotropy = 0 to take the model's away");
}

}  // namespace

Model load_part(const PartSettings& settings, ModelFiles& files) {
  Model model = load_content(settings, files);
  std::optional<TextureMap> layer;
  if (settings.layer) layer = load_layer(*settings.layer, model.warnings);
  for (Material& material : model.materials) apply(settings.brdf, settings.maps, material);
  if (settings.coat) {
    const std::optional<ClearCoat> coat = load_coat(*settings.coat, model.warnings);
    for (Material& material : model.materials) material.coat = coat;
  }
  lay_patches(settings, model);
  for (Material& material : model.materials) {
    tile(settings.tiling, material);
    material.layer_map = layer;
  }
  lay_maps(settings, model);
  for (Material& material : model.materials) {
    settle_anisotropy(material, model.warnings);
    add_name(settings.name, material.name);
  }
  if (settings.brdf.base_color || settings.maps.diffuse) whiten_vertices(model);
  for (Mesh& mesh : model.meshes) add_name(settings.name, mesh.name);
  return model;
}

WideBounds placed_bounds(const Placement& placement, const Model& model) {
  const Placer placer(placement, model.origin);
  WideBounds bounds;
  for (const Mesh& mesh : model.meshes) {
    for (const Vertex& vertex : mesh.vertices) bounds.add(placer.point(vertex.position));
  }
  return bounds;
}

void place(const Placement& placement, const glm::dvec3& origin, Model& model) {
  const Placer placer(placement, model.origin);
  const auto move = [&](glm::vec3& point) { point = glm::vec3(placer.point(point) - origin); };
  for (Mesh& mesh : model.meshes) {
    for (Vertex& vertex : mesh.vertices) move(vertex.position);
  }
  for (Light& light : model.lights) {
    if (glm::vec3* const position = position_in(light)) move(*position);
  }
  if (model.camera) {
    glm::vec3 eye(model.camera->world[3]);
    move(eye);
    model.camera->world[3] = {eye, 1.0F};
  }
  model.origin = origin;
  turn_directions(placer.rotation(), model);
}

}  // namespace footprint
