// Normals in 32 bits as the map has them, renormalised; lobes from the map of parameters.
#include "methods/ndf_atlas/facets.hpp"

#include "renderer/bake/material_maps.hpp"

namespace footprint::ndf_atlas {
namespace {

std::vector<glm::vec3> unit_normals(const Image& map) {
  std::vector<glm::vec3> normals(map.texel_count(), glm::vec3(0.0F));
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const float* const n = &map.texels[4 * i];
    const glm::dvec3 normal(n[0], n[1], n[2]);
    if (n[3] > 0.0F && glm::length(normal) >= 1e-3) normals[i] = glm::vec3(glm::normalize(normal));
  }
  return normals;
}

}  // namespace

std::optional<Facets> facets_of(const Material& material, bool rough) {
  const Image normals = normal_map_of(material);
  Facets facets{.width = normals.width,
                .height = normals.height,
                .distribution = material.brdf.distribution,
                .normals = unit_normals(normals),
                .parameters = {static_cast<float>(lobe_of(material).parameter)}};
  if (!rough) return facets;
  const Image parameters = lobe_parameter_map_of(material);
  if (parameters.texel_count() == 1) {
    facets.parameters = parameters.texels;
    return facets;
  }
  const bool on_each_other = roughness_coordinates(material) == normal_coordinates(material) &&
                             parameters.width <= normals.width && parameters.height <= normals.height;
  if (!on_each_other) return {};
  facets.parameters.clear();
  for (int y = 0; y < normals.height; ++y) {
    for (int x = 0; x < normals.width; ++x) {
      facets.parameters.push_back(
          parameters.at(x * parameters.width / normals.width, y * parameters.height / normals.height)[0]);
    }
  }
  return facets;
}

}  // namespace footprint::ndf_atlas
