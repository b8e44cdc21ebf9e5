// The texture lookups of each footprint filter, in double precision and apart from the shaders.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/footprint_filter.hpp"

namespace footprint {

/// A pixel's footprint on a map: centre and edges of a parallelogram, in texels of the finest level.
struct TexelFootprint {
  glm::dvec2 centre{0.0};  ///< (0, 0) is the corner of the first texel
  glm::dvec2 dx{1.0, 0.0}, dy{0.0, 1.0};
};

/// One trilinear lookup.
struct Probe {
  glm::dvec2 centre{0.0};  ///< texels of the finest level
  double weight = 1.0;     ///< the weights of a footprint's probes sum to 1
};

/// All lookups of one footprint.
struct ProbeSet {
  double level = 0.0;  ///< mip level, not clamped to the chain
  std::vector<Probe> probes;
};

/// The probes of a filter. `hardware` follows the formulas of the OpenGL extension; `shaded` has one probe per part.
/// docs/reference/filters.md gives the sources. Throws Error (usage): a stochastic filter.
[[nodiscard]] ProbeSet probes_of(const FootprintFilter& filter, const TexelFootprint& footprint);

}  // namespace footprint
