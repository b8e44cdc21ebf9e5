// The part of a normal map that a footprint's lookups reach: what has to be baked to look into that footprint.
#pragma once

#include <optional>

#include "renderer/ndf/footprint_texels.hpp"
#include "renderer/scene/footprint_filter.hpp"

namespace footprint {

/// A material whose normal map is a part of another's, and the same footprint in the part's own coordinates.
struct FootprintPart {
  Material material;
  FootprintRect rect;
};

/// The smallest part of the normal map whose mip levels are those of the whole map wherever `filter` looks for `rect`:
/// whole texels of the coarsest level that it takes, cut out across the border where the map repeats. The other maps
/// stay whole. None where the part would be more than half of the map, where sizes are no multiples of those texels,
/// and where the driver chooses the lookups (`hardware`).
[[nodiscard]] std::optional<FootprintPart> part_under(const Material& material, const FootprintRect& rect,
                                                      const FootprintFilter& filter);

}  // namespace footprint
