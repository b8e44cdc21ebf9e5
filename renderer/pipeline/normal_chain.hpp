// What several methods bake: the mean normal and the base lobe's width of every footprint, and the storage option.
#pragma once

#include <vector>

#include "renderer/core/options.hpp"
#include "renderer/image/image.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// The mip chain of a material's normal map: 3 channels, the mean of the unit normals, not renormalised, so that its
/// length tells their spread. Normals enter renormalised in 32 bits; invalid ones (weight 0) do not enter.
[[nodiscard]] std::vector<Image> mean_normal_chain(const Material& material);

/// The mip chain of a material's base lobe: 1 channel, the root of the footprint's mean slope variance per axis
/// (`lobe_variance`), at most 1. Variances of independent spreads add, so the mean is taken of them; the root is what
/// half floats and bytes keep well, where a mirror's variance of 1e-6 would not survive.
[[nodiscard]] std::vector<Image> lobe_deviation_chain(const Material& material);

/// `storage=fp32|fp16|unorm8`.
[[nodiscard]] OptionSpec storage_option();

}  // namespace footprint
