// Groups of texels of one roughness, so that normals are pooled with others of their own base lobe alone.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/scene/material.hpp"

namespace footprint::best_lobes {

struct RoughnessGroups {
  double narrowest = 0.0;                ///< the least slope variance of a base lobe
  std::vector<std::uint32_t> of_texels;  ///< row by row
  std::vector<double> spreads;           ///< of each group: its variance above the narrowest
};

/// The groups of a normal map of width x height texels, where roughness_lies_on_normals(material). The variances of a
/// group differ by a thousandth at most, and its own is their mean.
[[nodiscard]] RoughnessGroups roughness_groups(const Material& material, int width, int height);

}  // namespace footprint::best_lobes
