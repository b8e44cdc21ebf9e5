// A map of anisotropy beside the map of the lobe's width.
#pragma once

#include <string>
#include <vector>

#include "renderer/scene/material.hpp"

namespace footprint {

/// Gives Material::anisotropy_map and the map of the lobe's width one size, the larger one, so that each texel has
/// both. A constant width becomes a map. If the two have different coordinates, the map of anisotropy is left out, so
/// that its mean counts, with a warning that gives it.
void lay_anisotropy(Material& material, std::vector<std::string>& warnings);

}  // namespace footprint
