// What each footprint filter weighs the texels of a map by, in double precision and apart from the shaders: pictures of
// the kernels, their moments, and what the shaders are held against.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/image/image.hpp"
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
  double weight = 1.0;     ///< of all probes the sum is 1
};

/// The lookups that stand for a footprint.
struct ProbeSet {
  double level = 0.0;  ///< before it is clamped to the chain
  std::vector<Probe> probes;
};

/// The probes of a filter; those of `hardware` by the extension's formulas, those of `shaded` one for each part.
/// Sources: docs/filters.md.
[[nodiscard]] ProbeSet probes_of(const FootprintFilter& filter, const TexelFootprint& footprint);

/// The weight of every texel of the finest level, one channel, in a map of `size` texels a side (a power of two) that
/// wraps: the texels of two levels about each probe, each as even as box-filtered levels are. The sum is 1.
[[nodiscard]] Image filter_kernel(const FootprintFilter& filter, const TexelFootprint& footprint, int size);

/// The box that all of them stand for: the share of the parallelogram over each texel, from 16 x 16 points a texel.
[[nodiscard]] Image box_kernel(const TexelFootprint& footprint, int size);

/// Mean, and standard deviations along the footprint's longer and shorter principal axes, in texels.
struct KernelMoments {
  glm::dvec2 mean{0.0};
  double along = 0.0, across = 0.0;
};

/// Of a kernel that does not reach over the map's border.
[[nodiscard]] KernelMoments kernel_moments(const Image& kernel, const TexelFootprint& footprint);

}  // namespace footprint
