// The facets under a footprint, and the part of a normal map that a footprint needs.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "renderer/lobes/lobe.hpp"
#include "renderer/scene/footprint_filter.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// A rectangle in the texture coordinates of a material's normal map, where one map is the unit square.
struct FootprintRect {
  glm::dvec2 lower{0.0};
  glm::dvec2 upper{1.0};

  [[nodiscard]] glm::dvec2 size() const { return upper - lower; }
  [[nodiscard]] glm::dvec2 centre() const { return 0.5 * (lower + upper); }
};

/// How far from the map a footprint may reach, in maps.
inline constexpr double farthest_footprint = 64.0;

/// Facets of one normal and one lobe, and their share of the footprint's area.
struct WeightedFacet {
  glm::dvec3 normal{0.0, 0.0, 1.0};  ///< unit; of a facet with lobes of its own, the axis of one of them
  double parameter = 0.0;            ///< of the base lobe
  double share = 0.0;  ///< of the footprint, times the lobe's weight; over all facets the sum is 1 (weights')
};

/// What a footprint holds.
struct FootprintTexels {
  double texels = 0.0;                ///< its area in texels of the normal map
  double valid_share = 1.0;           ///< the part of the area whose texels have a normal
  std::vector<WeightedFacet> facets;  ///< distinct ones, sorted
};

/// Throws Error (usage): `place` names the rectangle that is empty, reversed, not finite or beyond
/// `farthest_footprint`.
void check_footprint(const FootprintRect& rect, const std::string& place);

/// Every facet of a material under `rect`: each texel of the normal map with the part of the rectangle that it covers,
/// wrapped as its coordinates say, with the roughness texels that lie over it where the roughness varies. Equal facets
/// are one; a facet with lobes of its own stands once for each of them; texels of weight 0 (no normal) do not count.
/// Throws Error (usage): no texel has a normal; the maps are turned against each other or use different sets of
/// coordinates; (machine): memory does not hold the facets.
[[nodiscard]] FootprintTexels texels_under(const Material& material, const FootprintRect& rect);

/// The footprint of the roughness map under the same surface: centre and edges (columns) in its own coordinates.
/// Throws Error (usage): as texels_under.
struct MappedFootprint {
  glm::dvec2 centre, along_u, along_v;
};
[[nodiscard]] MappedFootprint roughness_footprint(const Material& material, const FootprintRect& rect);

/// Facets merged where they are nearer to each other than about `spacing` (radians): their mean normal, not
/// renormalised, stands for them. A lobe's density is smooth, so its mean over a cell is that at the mean normal but
/// for (spacing / width)^2 / 4 of its peak at most, width being the lobe's.
[[nodiscard]] std::vector<WeightedFacet> merged_facets(const std::vector<WeightedFacet>& facets, double spacing);

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
