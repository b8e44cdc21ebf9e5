// The kernels of the footprint filters as images, and their moments, in double precision and apart from the shaders.
#pragma once

#include <glm/glm.hpp>

#include "renderer/image/image.hpp"
#include "renderer/ndf/filter_probes.hpp"

namespace footprint::testing {

/// The weights of a filter's texels, as an image of one channel: a map of `size` x `size` texels (a power of two) that
/// repeats. Each probe weights texels of two box-filtered levels. The sum is 1.
[[nodiscard]] Image filter_kernel(const FootprintFilter& filter, const TexelFootprint& footprint, int size);

/// The kernel of the box that all filters approximate: the share of the parallelogram over each texel, from 16 x 16
/// points per texel.
[[nodiscard]] Image box_kernel(const TexelFootprint& footprint, int size);

/// The mean of a kernel, and its standard deviations along the footprint's longer and shorter principal axes, in
/// texels.
struct KernelMoments {
  glm::dvec2 mean{0.0};
  double along = 0.0, across = 0.0;
};

/// The moments of a kernel within the map's border.
[[nodiscard]] KernelMoments kernel_moments(const Image& kernel, const TexelFootprint& footprint);

}  // namespace footprint::testing
