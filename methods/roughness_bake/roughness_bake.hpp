// The textures that baked_roughness.glsl reads.
#pragma once

#include <vector>

#include "methods/roughness_bake/presets.hpp"
#include "renderer/bake/prefiltered.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/scene/material.hpp"

namespace footprint::roughness_bake {

/// The preset's value of the spread for every texel of every level of a normal map's mip chain (as
/// Material::normal_map), one channel, from the finest level's normals.
[[nodiscard]] std::vector<Image> spread_chain(Image normals, Preset preset);

/// bake_mean_roughness, the mean normal, and the preset's values of the spread: `normal_spread` and `layer_spread`, one
/// channel, from the finest level's normals. Each only if `effects` has it. With unorm8 spreads are in half floats,
/// because bytes cannot store a sum of variances.
[[nodiscard]] Prefiltered bake_roughness(const Material& material, Preset preset, Storage storage,
                                         const EffectSet& effects);

/// Mip chains with the same sizes.
struct CommonLevels {
  std::vector<Image> rough;    ///< the mean roughness
  std::vector<Image> normals;  ///< values over the normal map
};

/// Both with the sizes of the larger map, whose finer levels repeat the texels of the smaller one.
/// over_normals: a chain of the normal map.
/// Throws Error (usage): one roughness map cannot store both.
[[nodiscard]] CommonLevels common_levels(const Material& material, const std::vector<Image>& over_normals);

}  // namespace footprint::roughness_bake
