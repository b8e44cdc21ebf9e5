// The facets under a footprint, and the part of a normal map that a footprint covers.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "renderer/scene/footprint_filter.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// A rectangle in the texture coordinates of a normal map; the unit square is one period of the map.
struct FootprintRect {
  glm::dvec2 lower{0.0};
  glm::dvec2 upper{1.0};

  [[nodiscard]] glm::dvec2 size() const { return upper - lower; }
  [[nodiscard]] glm::dvec2 centre() const { return 0.5 * (lower + upper); }
};

/// The largest distance of a footprint from the map, in periods.
inline constexpr double farthest_footprint = 64.0;

/// Facets with the same normal and lobe, and their share of the footprint.
struct WeightedFacet {
  glm::dvec3 normal{0.0, 0.0, 1.0};  ///< unit; the axis of one lobe if the facet has several
  double parameter = 0.0;            ///< parameter of the base lobe
  double share = 0.0;  ///< share of the footprint times the weight of the lobe; sums to 1, or to the sum of the weights
  glm::dvec2 stretch{0.0};  ///< of the lobe (stretch_of), whose round mean has `parameter`
};

/// The facets under a footprint.
struct FootprintTexels {
  double texels = 0.0;                ///< its area in texels of the normal map
  double valid_share = 1.0;           ///< the share of the area whose texels have a normal
  std::vector<WeightedFacet> facets;  ///< distinct ones, sorted
};

/// Throws Error (usage) if a rectangle is empty, reversed, not finite or beyond `farthest_footprint`. `place` describes
/// the rectangle in the message.
void check_footprint(const FootprintRect& rect, const std::string& place);

/// Collects the facets of a material under `rect`. Each texel of the normal map counts with the covered part of the
/// rectangle; coordinates wrap as the material says. Where the roughness varies, the overlapping roughness texels split
/// it.
/// Equal facets are merged; a facet with several lobes has one entry per lobe; texels of weight 0 (no normal) are
/// skipped.
/// Throws Error (usage) if no texel has a normal, or if the maps are rotated against each other or use different
/// texture coordinates; Error (machine) if memory is too small.
[[nodiscard]] FootprintTexels texels_under(const Material& material, const FootprintRect& rect);

/// A footprint in the coordinates of the roughness map: centre and edge vectors.
struct MappedFootprint {
  glm::dvec2 centre, along_u, along_v;
};
/// Maps `rect` to the roughness map. Throws Error (usage) as texels_under does.
[[nodiscard]] MappedFootprint roughness_footprint(const Material& material, const FootprintRect& rect);

/// Merges facets that are closer than about `spacing` (radians) into their mean normal, which is not renormalised. For
/// smooth lobes the error is at most (spacing / width)^2 / 4 of the peak, with the width of the lobe.
[[nodiscard]] std::vector<WeightedFacet> merged_facets(const std::vector<WeightedFacet>& facets, double spacing);

/// A material whose normal map is cut out of another one, and the footprint in its coordinates.
struct FootprintPart {
  Material material;
  FootprintRect rect;
};

/// Cuts out the smallest part of the normal map that has the same mip levels as the whole map for all lookups of
/// `filter` in `rect`. The part consists of whole texels of the coarsest level used, and crosses the border of a
/// repeating map. Other maps stay unchanged.
/// Returns nothing if the part would exceed half of the map, if the size of the map is not a multiple of those texels,
/// or if the driver chooses the lookups (`hardware`).
[[nodiscard]] std::optional<FootprintPart> part_under(const Material& material, const FootprintRect& rect,
                                                      const FootprintFilter& filter);

}  // namespace footprint
