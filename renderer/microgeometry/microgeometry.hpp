// The small-scale geometry of a material: a patch, and what of it those need who do not look at its triangles.
#pragma once

#include <glm/glm.hpp>
#include <memory>

#include "renderer/image/image.hpp"
#include "renderer/microgeometry/patch.hpp"
#include "renderer/microgeometry/tabulated_brdf.hpp"

namespace footprint {

/// What a material carries. Its base colour has the patch's mean colour multiplied in, so that a method which leaves
/// the patch's colours out has the right mean.
struct Microgeometry {
  Patch patch;
  glm::vec3 mean_color{1.0F};                   ///< of what is seen from straight above
  std::shared_ptr<const TabulatedBrdf> brdf{};  ///< of the facets, diffuse light and all; null: the material's own
};

/// Whether the facets' paints must be told apart: there are several, or one that is in no base colour, since the
/// facets' BRDF is tabulated.
[[nodiscard]] bool needs_colors(const Microgeometry& microgeometry);

/// A patch as it is seen from straight above, size x size texels over its period.
struct PatchMaps {
  Image normals;  ///< 4 channels: unit normal, weight 0 where nothing is or faces up
  glm::vec3 mean_color{1.0F};
};

/// Casts one ray at each texel's centre. `size` is 1 or more.
[[nodiscard]] PatchMaps patch_maps(const Patch& patch, int size);

}  // namespace footprint
