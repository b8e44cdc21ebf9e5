// Where the reference samples a pixel: a jittered grid, taken in passes of grid x grid samples.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace footprint {

/// N = passes * grid^2 samples a pixel. One pass draws a picture grid times as large each way, whose samples lie in one
/// point of their cell; the passes' points are stratified over the cell and jittered within their strata, so that all
/// samples together are a jittered grid.
struct SampleGrid {
  int grid = 1;
  std::vector<glm::dvec2> offsets;  ///< one a pass: from a cell's centre, in cells, -0.5 to 0.5
};

/// 1 <= spp <= 4096. Deterministic for a seed. Errors (usage): spp out of range.
[[nodiscard]] SampleGrid sample_grid(int spp, std::uint64_t seed);

}  // namespace footprint
