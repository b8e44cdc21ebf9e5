// Moments of slope as OpenImageIO's `maketx --bumpslopes` lays them out: six channels, mip-mapped; out of and into
// LEAN's maps.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderer/bake/prefiltered.hpp"
#include "renderer/image/image_io.hpp"

namespace footprint {

/// The channels of the layout, in its order: height (-1 of what was made from a normal map), the slopes along u and v
/// and the means of their products.
[[nodiscard]] const std::vector<std::string>& bumpslopes_channels();

/// The moments in a bake's `slope_moments` and `slope_rest` (bake_slopes) in that layout. None where it has not both,
/// or no whole covariance.
[[nodiscard]] std::optional<ExrChain> bumpslopes_of(const Prefiltered& prefiltered);

/// The normals that the finest level's slopes stand for: 4 channels, as Material::normal_map. `file` is for messages.
/// OpenImageIO's slopes of a height map are per texel and, along v, down the rows; those of a normal map up, as its
/// green channel: the first are turned round. Throws Error (usage): other channels, a level that is missing, no finite
/// number.
[[nodiscard]] Image normals_of_bumpslopes(const ExrChain& chain, const std::string& file);

/// Puts the chain's moments in the place of those that were baked from its finest level's normals, so that what its
/// coarser levels hold beyond them counts. Storage, coordinates and a mean normal stay. Throws std::logic_error where
/// the bake has no such textures, of that size.
void replace_moments(const ExrChain& chain, Prefiltered& prefiltered);

/// Whether a bake has such textures.
[[nodiscard]] bool holds_slope_moments(const Prefiltered& prefiltered);

}  // namespace footprint
