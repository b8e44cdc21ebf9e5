// The base lobe of a material, and access to its maps.
#include "renderer/scene/material.hpp"

#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "renderer/core/bytes.hpp"
#include "renderer/microgeometry/microgeometry.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {
namespace {

// Slope variance per axis of all lobes together about the facet's normal: each lobe's own, and that of its axis.
float variance_about_normal(const Material& material) {
  float weight = 0.0F;
  float variance = 0.0F;
  for (const FacetLobe& lobe : material.lobes) {
    const float leaning = 0.5F * glm::dot(glm::vec2(lobe.axis), glm::vec2(lobe.axis)) / (lobe.axis.z * lobe.axis.z);
    weight += lobe.weight;
    variance += lobe.weight * (lobe_variance({material.brdf.distribution, lobe.parameter}) + leaning);
  }
  return variance / weight;
}

// The maps that a material has, which may be const.
template <class Map, class AnyMaterial>
std::vector<Map*> maps_in(AnyMaterial& material) {
  std::vector<Map*> maps;
  const auto add = [&](auto& map) {
    if (map) maps.push_back(&*map);
  };
  add(material.base_color_map);
  add(material.metallic_roughness_map);
  add(material.lobe_parameter_map);
  add(material.anisotropy_map);
  add(material.specular_map);
  add(material.emission_map);
  add(material.occlusion_map);
  add(material.normal_map);
  add(material.layer_map);
  if (material.coat) {
    add(material.coat->weight_map);
    add(material.coat->roughness_map);
    add(material.coat->normal_map);
  }
  return maps;
}

// The lobe of a constant roughness, across the direction of anisotropy if there is one.
Lobe own_lobe_of(const Material& material) {
  const NormalDistribution distribution = material.brdf.distribution;
  if (material.lobe_parameter) return {distribution, *material.lobe_parameter};
  if (!material.lobes.empty()) return lobe_from_variance(distribution, variance_about_normal(material));
  const TextureMap* const map = width_map(material);
  if (map != nullptr && material.lobe_parameter_map) return {distribution, map->image.first().front()};
  const float roughness = map != nullptr ? map->image.first().front() : material.roughness;
  return lobe_from_alpha(distribution, roughness * roughness);
}

}  // namespace

std::vector<TextureMap*> maps_of(Material& material) { return maps_in<TextureMap>(material); }

std::vector<const TextureMap*> maps_of(const Material& material) { return maps_in<const TextureMap>(material); }

Alphas alphas_of(const Material& material, double alpha) {
  return anisotropic_alphas(material.anisotropy.value_or(Anisotropy{}).strength, alpha);
}

Alphas alphas_of(const Material& material) { return alphas_of(material, own_lobe_of(material).parameter); }

Lobe lobe_of(const Material& material) {
  const Lobe own = own_lobe_of(material);
  if (!material.anisotropy) return own;
  return {own.distribution, static_cast<float>(round_alpha(alphas_of(material, own.parameter)))};
}

// Found by ByteArchive. What is left out does not count; structured bindings do not compile once a field is added.
template <class T>
void fields(ByteArchive& archive, const std::shared_ptr<const T>& value) {
  archive(value != nullptr);
  if (value) archive(*value);
}

template <class... T>
void fields(ByteArchive& archive, const std::variant<T...>& value) {
  archive(value.index());
  std::visit(archive, value);
}

void fields(ByteArchive& archive, const TextureMap& map) {
  const auto& [name, image, coordinates] = map;
  archive(static_cast<bool>(image), image ? image.decoded() : Image(), coordinates);
}

void fields(ByteArchive& archive, const Patch& patch) {
  const auto& [name, period, vertices, triangles, paints, palette] = patch;
  archive(period, vertices, triangles, paints, palette);
}

void fields(ByteArchive& archive, const Material& material) {
  const auto& [name, brdf, base_color, dielectric_specular, metallic, roughness, lobe_parameter, lobes, anisotropy,
               base_color_map, metallic_roughness_map, lobe_parameter_map, anisotropy_map, specular_map, emission,
               emission_map, occlusion_map, normal_map, layer_map, coat, share, alpha_cutoff, double_sided, unlit,
               microgeometry] = material;
  archive(brdf, base_color, dielectric_specular, metallic, roughness, lobe_parameter, lobes, anisotropy);
  archive(base_color_map, metallic_roughness_map, lobe_parameter_map, specular_map, normal_map, layer_map, coat);
  archive(anisotropy_map, emission, emission_map, occlusion_map);
  archive(share, alpha_cutoff, double_sided, unlit, microgeometry);
}

void fields(ByteArchive& archive, const Scene& scene) {
  const auto& [name, source, meshes, materials, lights, shadows, horizon, environment, camera, bounds, origin,
               footprint, exposure, distances, frame_size, choices, motion, defaults, warnings] = scene;
  archive(name, meshes, materials, lights, shadows, horizon, environment, camera, bounds, origin, footprint, exposure);
  archive(distances, frame_size, motion, defaults, warnings);
  for (const Material& material : materials) archive(material.name);
}

template <class Value>
void add(ContentHash& hash, const Value& value) {
  ByteArchive archive([&](std::span<const std::uint8_t> piece) { hash.add(std::as_bytes(piece)); });
  archive(value);
}

void add_content(ContentHash& hash, const Material& material) { add(hash, material); }

void add_content(ContentHash& hash, const Scene& scene) { add(hash, scene); }

}  // namespace footprint
