// The base lobe of a material, and access to its maps.
#include "renderer/scene/material.hpp"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <variant>
#include <vector>

#include "renderer/core/members.hpp"
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

// Of a constant material or another.
template <class Map, class AnyMaterial>
std::vector<Map*> maps_in(AnyMaterial& material) {
  std::vector<Map*> maps;
  const auto add = [&](auto& map) {
    if (map) maps.push_back(&*map);
  };
  add(material.base_color_map);
  add(material.metallic_roughness_map);
  add(material.lobe_parameter_map);
  add(material.specular_map);
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

// Values that are their bytes; of structures those without gaps between their members.
template <class T>
constexpr bool is_plain = std::is_arithmetic_v<T> || std::is_enum_v<T>;
template <int size, class T, glm::qualifier q>
constexpr bool is_plain<glm::vec<size, T, q>> = true;
template <int columns, int rows, class T, glm::qualifier q>
constexpr bool is_plain<glm::mat<columns, rows, T, q>> = true;
template <>
constexpr bool is_plain<TextureCoordinates> = sizeof(TextureCoordinates) == (1 + 6 + 2) * 4;
template <>
constexpr bool is_plain<FacetLobe> = sizeof(FacetLobe) == (3 + 1 + 1) * 4;
template <>
constexpr bool is_plain<Anisotropy> = sizeof(Anisotropy) == (1 + 1) * 4;
template <>
constexpr bool is_plain<Vertex> = sizeof(Vertex) == (3 + 3 + 4 + 2 + 2 + 4) * 4;
template <>
constexpr bool is_plain<DirectionalLight> = sizeof(DirectionalLight) == (3 + 3) * 4;
template <>
constexpr bool is_plain<AreaLight> = sizeof(AreaLight) == (1 + 3 + 3 + 3 + 3 + 2 + 3 + 1 + 1) * 4;
template <>
constexpr bool is_plain<Bounds> = sizeof(Bounds) == (3 + 3) * 4;
template <>
constexpr bool is_plain<Motion> = sizeof(Motion) == (1 + 1) * 8;
template <>
constexpr bool is_plain<FootprintFilter> = sizeof(FootprintFilter) == (1 + 1 + 1) * 4;

// Counts values into a hash, all members of structures. Those that leave a member out, or have many, are taken apart by
// structured bindings: one with a field more does not compile until that field is counted.
class Counter {
 public:
  explicit Counter(ContentHash& hash) : hash_(&hash) {}

  template <class T>
  requires is_plain<T>
  void add(const T& value) { hash_->add(std::as_bytes(std::span(&value, 1))); }

  template <class T>
  void add(const std::vector<T>& values) {
    if constexpr (is_plain<T>) {
      hash_->add(std::as_bytes(std::span(values)));
    } else {
      add(values.size());
      for (const T& value : values) add(value);
    }
  }

  template <class T>
  void add(const std::optional<T>& value) {
    add(value.has_value());
    if (value) add(*value);
  }

  template <class T>
  void add(const std::shared_ptr<const T>& value) {
    add(value != nullptr);
    if (value) add(*value);
  }

  void add(const std::string& text) { hash_->add(text); }

  template <class T>
  requires(std::is_aggregate_v<T> && !is_plain<T>) void add(const T& value) {
    std::apply([this](const auto&... members) { this->add_all(members...); }, members_of(value));
  }

  template <class... T>
  void add(const std::variant<T...>& value) {
    add(value.index());
    std::visit([this](const auto& content) { this->add(content); }, value);
  }

  void add(const Image& image) {
    const auto& [width, height, channels, texels] = image;
    add_all(width, height, channels, texels);
  }

  void add(const TextureMap& map) {
    const auto& [name, image, coordinates] = map;
    add(static_cast<bool>(image));
    if (image) add(image.decoded());
    add(coordinates);
  }

  void add(const Patch& patch) {
    const auto& [name, period, vertices, triangles, paints, palette] = patch;
    add_all(period, vertices, triangles, paints, palette);
  }

  void add(const Material& material) {
    const auto& [name, brdf, base_color, dielectric_specular, metallic, roughness, lobe_parameter, lobes, anisotropy,
                 base_color_map, metallic_roughness_map, lobe_parameter_map, specular_map, normal_map, layer_map, coat,
                 share, alpha_cutoff, double_sided, unlit, microgeometry] = material;
    add_all(brdf, base_color, dielectric_specular, metallic, roughness, lobe_parameter, lobes, anisotropy);
    add_all(base_color_map, metallic_roughness_map, lobe_parameter_map, specular_map, normal_map, layer_map, coat);
    add_all(share, alpha_cutoff, double_sided, unlit, microgeometry);
  }

  void add(const Scene& scene) {
    const auto& [name, source, meshes, materials, lights, shadows, horizon, environment, camera, bounds, footprint,
                 exposure, distances, frame_size, choices, motion, defaults, warnings] = scene;
    add_all(name, meshes, materials, lights, shadows, horizon, environment, camera, bounds, footprint, exposure);
    add_all(distances, frame_size, motion, defaults, warnings);
    for (const Material& material : materials) add(material.name);
  }

 private:
  template <class... T>
  void add_all(const T&... values) {
    (add(values), ...);
  }

  ContentHash* hash_;
};

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

void add_content(ContentHash& hash, const Material& material) { Counter(hash).add(material); }

void add_content(ContentHash& hash, const Scene& scene) { Counter(hash).add(scene); }

}  // namespace footprint
