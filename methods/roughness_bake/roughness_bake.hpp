// The textures that baked_roughness.glsl reads.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "methods/roughness_bake/presets.hpp"
#include "renderer/bake/prefiltered.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/image/image.hpp"
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

/// A lobe of KHR_materials_anisotropy: alpha is roughness^2 across the direction, and mix(alpha, 1, strength^2) along.
struct DirectedRoughness {
  glm::dvec2 direction{1.0, 0.0};  ///< in the tangent plane, unit; its opposite is the same
  double strength = 0.0, roughness = 1.0;
};

/// The lobe whose squared widths are alpha2 plus twice the covariance of slopes about the normal; none is wider than 1.
[[nodiscard]] DirectedRoughness directed_roughness(const glm::dmat2& covariance, double alpha2);

/// The covariance of slopes about their mean, seen from the normal of the mean slope (common_slopes.glsl, Jacobian).
[[nodiscard]] glm::dmat2 covariance_about(const glm::dvec2& mean, const glm::dmat2& covariance);

/// The lobe at every texel of every level, 4 channels from 0 to 1: (direction + 1) / 2, strength, roughness. Directions
/// have the sign that is closest to the direction of the coarsest level, so that texture filters can blend them.
/// Throws Error (usage): one roughness map cannot store the material's maps, or its lobe is neither GGX nor Beckmann.
[[nodiscard]] std::vector<Image> directed_chain(const Material& material);

}  // namespace footprint::roughness_bake
