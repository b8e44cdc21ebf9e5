// The small-scale geometry of a material: a patch, and properties that do not require its triangles.
#pragma once

#include <glm/glm.hpp>
#include <memory>

#include "renderer/image/image.hpp"
#include "renderer/microgeometry/patch.hpp"
#include "renderer/microgeometry/tabulated_brdf.hpp"

namespace footprint {

/// The microgeometry of a material. The base colour of the material includes the patch's mean colour, so that methods
/// without facet colours have the right mean.
struct Microgeometry {
  Patch patch;
  glm::vec3 mean_color{1.0F};  ///< mean colour seen from directly above
  std::shared_ptr<const TabulatedBrdf>
      brdf{};  ///< of the facets, including diffuse light; null: the BRDF of the material
};

/// Whether facets need separate colours: there are several paints, or one that the base colour omits because the BRDF
/// of the facets is tabulated.
[[nodiscard]] bool needs_colors(const Microgeometry& microgeometry);

/// Maps of a patch seen from directly above, size x size texels over one period.
struct PatchMaps {
  Image normals;  ///< 4 channels: unit normal, weight 0 where no upward facet is visible
  glm::vec3 mean_color{1.0F};
};

/// Casts one ray per texel centre. `size` is at least 1.
[[nodiscard]] PatchMaps patch_maps(const Patch& patch, int size);

}  // namespace footprint
