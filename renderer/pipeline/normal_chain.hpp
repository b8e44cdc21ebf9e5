// What several methods bake: the mean normal of every footprint, and the option of how it is stored.
#pragma once

#include <vector>

#include "renderer/core/options.hpp"
#include "renderer/image/image.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// The mip chain of a material's normal map: 3 channels, the mean of the unit normals, not renormalised, so that its
/// length tells their spread. Normals enter renormalised in 32 bits; invalid ones (weight 0) do not enter.
[[nodiscard]] std::vector<Image> mean_normal_chain(const Material& material);

/// `storage=fp32|fp16|unorm8`.
[[nodiscard]] OptionSpec storage_option();

}  // namespace footprint
