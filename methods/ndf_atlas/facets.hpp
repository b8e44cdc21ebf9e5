// The facets of a material, texel by texel of its normal map: what tables are sums over.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "renderer/lobes/lobe.hpp"
#include "renderer/scene/material.hpp"

namespace footprint::ndf_atlas {

struct Facets {
  int width = 0, height = 0;
  NormalDistribution distribution = NormalDistribution::blinn_phong;
  std::vector<glm::vec3> normals;  ///< unit, row by row; zero where the map has none
  std::vector<float> parameters;   ///< of each facet's lobe, or one for all

  [[nodiscard]] bool is_valid(std::size_t i) const { return normals[i] != glm::vec3(0.0F); }
  [[nodiscard]] Lobe lobe(std::size_t i) const {
    return {distribution, static_cast<double>(parameters[parameters.size() == 1 ? 0 : i])};
  }
};

/// Those of a material; `rough`: each with the lobe of the texel of the roughness map above it. None where that map
/// does not lie on the normal map's texels, or is finer.
[[nodiscard]] std::optional<Facets> facets_of(const Material& material, bool rough);

}  // namespace footprint::ndf_atlas
