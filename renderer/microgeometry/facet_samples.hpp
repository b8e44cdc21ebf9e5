// Points on a patch with probability proportional to area: each stands for a planar facet of one and the same area.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/microgeometry/patch.hpp"

namespace footprint {

/// Facets of equal area, each on a triangle of the patch.
struct FacetSamples {
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> triangles;  ///< what each lies on
  double facet_area = 0.0;               ///< of each, in the patch's units

  [[nodiscard]] std::size_t size() const { return positions.size(); }
};

/// `count` >= 1 samples, one in each of `count` equal shares of the area (stratified), in the order of the triangles:
/// a triangle gets its share to within one. Same seed, same samples. The patch is as check_patch wants it.
[[nodiscard]] FacetSamples sample_facets(const Patch& patch, std::size_t count, std::uint64_t seed);

}  // namespace footprint
