// Converts slope moments between LEAN's maps and the layout of OpenImageIO's `maketx --bumpslopes`: six mip-mapped
// channels.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderer/bake/prefiltered.hpp"
#include "renderer/image/image_io.hpp"

namespace footprint {

/// The channels in order: height (-1 if made from a normal map), the slopes along u and v, and the means of their
/// products.
[[nodiscard]] const std::vector<std::string>& bumpslopes_channels();

/// Converts `slope_moments` and `slope_rest` of a bake (bake_slopes) to that layout. Nothing if one is missing or the
/// covariance is not complete.
[[nodiscard]] std::optional<ExrChain> bumpslopes_of(const Prefiltered& prefiltered);

/// The normals of the slopes in the finest level: 4 channels, as Material::normal_map. OpenImageIO's slopes of a height
/// map are per texel and point down along v; those of a normal map point up, as its green channel. The former are
/// converted.
/// file: for messages.
/// Throws Error (usage): wrong channels, a missing level, or a value that is not finite.
[[nodiscard]] Image normals_of_bumpslopes(const ExrChain& chain, const std::string& file);

/// Replaces the moments that were baked from the finest level by those of the chain, whose coarser levels may contain
/// more. Storage, coordinates and a mean normal stay. Throws std::logic_error if the bake has no such textures of that
/// size.
void replace_moments(const ExrChain& chain, Prefiltered& prefiltered);

/// Whether a bake has such textures.
[[nodiscard]] bool holds_slope_moments(const Prefiltered& prefiltered);

}  // namespace footprint
