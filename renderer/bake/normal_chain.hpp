// What several methods bake: the mean normal of every footprint, the base lobe's width, and how they are stored.
#pragma once

#include <vector>

#include "renderer/bake/prefiltered.hpp"
#include "renderer/core/options.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/image/image.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// The mip chain of a normal map (as Material::normal_map): 3 channels, the mean of the unit normals, not renormalised,
/// so that its length, the mean resultant length, tells their spread. Normals enter renormalised in 32 bits; invalid
/// ones (weight 0) do not enter.
[[nodiscard]] std::vector<Image> mean_normal_chain(Image normals);

/// That of the material's own normal map.
[[nodiscard]] std::vector<Image> mean_normal_chain(const Material& material);

/// 1 - |Na| of a mean of that chain, without what its 32 bits make of the length where all normals agree: the twin of
/// shortfallOfLength in length_shortfall.glsl.
[[nodiscard]] double shortfall_of_length(double length);

/// The texture `mean_normal` that mean_normal.glsl reads, of that chain; none where normals do not vary.
[[nodiscard]] Prefiltered bake_mean_normal(const Material& material, Storage storage, const EffectSet& effects);

/// Slope variance per axis of the base lobe at every texel of the roughness map (1 x 1 where it has none), one channel.
[[nodiscard]] Image lobe_variance_map(const Material& material);

/// The mip chain of lobe_variance_map, which is what adds up when spreads are independent.
[[nodiscard]] std::vector<Image> lobe_variance_chain(const Material& material);

/// The texture `lobe_variance` that lobe_variance.glsl reads, of that chain; none where the roughness does not vary.
/// What is stored is linear in the variance, so that texels blend as variances do: in units of stored_lobe_variance,
/// which keeps all from a mirror's 1e-6 to the 1000 of an exponent of 0.001 in half floats, and for `unorm8` too in
/// half floats, since bytes would make a mirror of every lobe below 1 / 255.
[[nodiscard]] Prefiltered bake_lobe_variance(const Material& material, Storage storage, const EffectSet& effects);

/// The unit in which that texture holds variances: a power of two, nothing is rounded by it.
inline constexpr float stored_lobe_variance = 1.0F / 64.0F;

/// `storage=fp32|fp16|unorm8`.
[[nodiscard]] OptionSpec storage_option();

/// `storage=fp32|fp16`, for values that exceed the range of 8-bit fixed point.
[[nodiscard]] OptionSpec float_storage_option();

}  // namespace footprint
