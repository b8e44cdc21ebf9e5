// The one lobe that stands for all of a material's.
#include "renderer/scene/material.hpp"

namespace footprint {
namespace {

// Slope variance per axis of all lobes together, about the facet's normal: each lobe's own, and what its axis leans by.
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

}  // namespace

Lobe lobe_of(const Material& material) {
  const NormalDistribution distribution = material.brdf.distribution;
  if (material.lobe_parameter) return {distribution, *material.lobe_parameter};
  if (!material.lobes.empty()) return lobe_from_variance(distribution, variance_about_normal(material));
  const TextureMap* const map = width_map(material);
  if (map != nullptr && material.lobe_parameter_map) return {distribution, map->image.first().front()};
  const float roughness = map != nullptr ? map->image.first().front() : material.roughness;
  return lobe_from_alpha(distribution, roughness * roughness);
}

}  // namespace footprint
