// Bakes that several methods share: mean normals, the base lobe's width, and their storage.
#pragma once

#include <string>
#include <vector>

#include "renderer/bake/prefiltered.hpp"
#include "renderer/core/options.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/image/image.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// The mip chain of a normal map (as Material::normal_map): 3 channels, the mean of the unit normals. It is not
/// renormalised, because its length measures their spread. Normals are first renormalised in 32 bits; invalid ones
/// (weight 0) are skipped.
[[nodiscard]] std::vector<Image> mean_normal_chain(Image normals);

/// The chain of the material's own normal map.
[[nodiscard]] std::vector<Image> mean_normal_chain(const Material& material);

/// 1 - |Na| of a mean of that chain, corrected for the rounding of its 32 bits. C++ version of shortfallOfLength in
/// length_shortfall.glsl.
[[nodiscard]] double shortfall_of_length(double length);

/// The texture `mean_normal` of mean_normal.glsl, from that chain; none if normals do not vary. With bc5 it has x and y
/// of the renormalised means, so that their lengths are lost.
[[nodiscard]] Prefiltered bake_mean_normal(const Material& material, Storage storage, const EffectSet& effects);

/// Slope variance per axis of the base lobe at every texel of the roughness map, one channel; without a map 1 x 1.
[[nodiscard]] Image lobe_variance_map(const Material& material);

/// The mip chain of lobe_variance_map. Variances of independent spreads add.
[[nodiscard]] std::vector<Image> lobe_variance_chain(const Material& material);

/// What the roughness of a footprint is the mean of.
enum class RoughnessMean {
  variance,      ///< slope variance: keeps the second moment of the lobes
  concentration  ///< 1 / variance: keeps the peak of the lobes about one normal
};

/// `roughness_mean=variance|concentration`.
[[nodiscard]] OptionSpec roughness_mean_option();
[[nodiscard]] RoughnessMean roughness_mean(const Options& options);

/// The value that a texel stores for a slope variance: the variance in units of stored_lobe_variance, or the reciprocal
/// of that.
[[nodiscard]] float stored_roughness(float variance, RoughnessMean mean);

/// The name of the texture of lobe_variance.glsl that stores them: `lobe_variance` or `lobe_concentration`.
[[nodiscard]] std::string stored_lobe_name(RoughnessMean mean);

/// The texture of that name; none if the roughness does not vary. Values are
/// variances in units of stored_lobe_variance, or the reciprocals of that, so that texels blend correctly, and half
/// floats represent the range from a mirror's 1e-6 to 1000 for an exponent of 0.001. `unorm8` also uses half floats,
/// because bytes would round every lobe below 1/255 to a mirror.
[[nodiscard]] Prefiltered bake_lobe_variance(const Material& material, Storage storage, const EffectSet& effects,
                                             RoughnessMean mean = RoughnessMean::variance);

/// The unit of variances in that texture: a power of two, so that scaling does not round.
inline constexpr float stored_lobe_variance = 1.0F / 64.0F;

/// The texture `mean_roughness` of mean_roughness.glsl, means of the perceptual roughness as importers make them; none
/// if the roughness does not vary.
[[nodiscard]] Prefiltered bake_mean_roughness(const Material& material, Storage storage, const EffectSet& effects);

/// `storage=fp32|fp16|unorm8`.
[[nodiscard]] OptionSpec storage_option();

/// `storage=fp32|fp16|unorm8|bc1`, and bc5 for a method that uses the mean normal's direction alone.
[[nodiscard]] OptionSpec block_storage_option(bool renormalises);

/// `storage=fp32|fp16`, for values that exceed the range of 8-bit fixed point.
[[nodiscard]] OptionSpec float_storage_option();

}  // namespace footprint
