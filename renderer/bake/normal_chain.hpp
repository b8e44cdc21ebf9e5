// Bakes that several methods share: the mean normal, the width of the base lobe, and their storage.
#pragma once

#include <vector>

#include "renderer/bake/prefiltered.hpp"
#include "renderer/core/options.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/image/image.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// The mip chain of a normal map (as Material::normal_map): 3 channels, the mean of the unit normals, not renormalised.
/// Its length, the mean resultant length, gives the spread of the normals. Normals are renormalised in 32 bits; invalid
/// ones (weight 0) are left out.
[[nodiscard]] std::vector<Image> mean_normal_chain(Image normals);

/// The chain of the material's own normal map.
[[nodiscard]] std::vector<Image> mean_normal_chain(const Material& material);

/// 1 - |Na| of a mean of that chain, without the 32-bit rounding error of the length where all normals agree. The twin
/// of shortfallOfLength in length_shortfall.glsl.
[[nodiscard]] double shortfall_of_length(double length);

/// That chain as texture `mean_normal`, which mean_normal.glsl reads; none if normals do not vary.
[[nodiscard]] Prefiltered bake_mean_normal(const Material& material, Storage storage, const EffectSet& effects);

/// Slope variance per axis of the base lobe at every texel of the roughness map (1 x 1 without one), one channel.
[[nodiscard]] Image lobe_variance_map(const Material& material);

/// The mip chain of lobe_variance_map. Variances add up if spreads are independent.
[[nodiscard]] std::vector<Image> lobe_variance_chain(const Material& material);

/// That chain as texture `lobe_variance`, which lobe_variance.glsl reads; none if the roughness does not vary. Stored
/// values are linear in the variance, so that texels blend as variances do. Their unit is stored_lobe_variance, with
/// which half floats represent 1e-6 of a mirror up to 1000 of an exponent of 0.001. `unorm8` is stored in half floats,
/// too, because bytes would make every lobe below 1 / 255 a mirror.
[[nodiscard]] Prefiltered bake_lobe_variance(const Material& material, Storage storage, const EffectSet& effects);

/// The unit of that texture's variances, a power of two, so that it does not round.
inline constexpr float stored_lobe_variance = 1.0F / 64.0F;

/// `storage=fp32|fp16|unorm8`.
[[nodiscard]] OptionSpec storage_option();

/// `storage=fp32|fp16`, for values that exceed the range of 8-bit fixed point.
[[nodiscard]] OptionSpec float_storage_option();

}  // namespace footprint
