// The base lobe of a material, and access to its maps.
#include "renderer/scene/material.hpp"

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

}  // namespace footprint
