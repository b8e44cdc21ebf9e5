// The textures that baked_roughness.glsl reads.
#pragma once

#include <vector>

#include "methods/roughness_bake/presets.hpp"
#include "renderer/bake/prefiltered.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/scene/material.hpp"

namespace footprint::roughness_bake {

/// What the preset stores of the spread under every texel of every level of a normal map's mip chain (as
/// Material::normal_map), one channel, from the finest level's normals.
[[nodiscard]] std::vector<Image> spread_chain(Image normals, Preset preset);

/// The mean roughness: the texture `baked_roughness`; none where the roughness does not vary.
[[nodiscard]] Prefiltered bake_mean_roughness(const Material& material, Storage storage, const EffectSet& effects);

/// That, the mean normal and what the preset stores of the normals' spread: `normal_spread`, `layer_spread`, one
/// channel, from the finest level's normals; each where `effects` has it. Spreads are in half floats where the rest is
/// in bytes, which hold no sum of variances.
[[nodiscard]] Prefiltered bake_roughness(const Material& material, Preset preset, Storage storage,
                                         const EffectSet& effects);

}  // namespace footprint::roughness_bake
