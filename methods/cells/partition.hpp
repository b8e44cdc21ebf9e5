// Partitions the normals of a material: the share of each texel in each part, the same for all levels.
#pragma once

#include <span>
#include <vector>

#include "methods/cells/plane.hpp"
#include "renderer/core/progress.hpp"

namespace footprint::cells {

constexpr int most_parts = 8;

/// How texels are assigned to parts. global: by one mixture over the whole map. joint: so that one Gaussian per part
/// describes blocks of every size.
enum class Labels { joint, global };

struct PartitionSettings {
  int parts = 4;
  Labels labels = Labels::joint;
  double variance = 1.0 / 64.0;  ///< slope variance per axis of the base lobe, which limits the resolution of parts
  int rounds = 20;               ///< of `joint`
};

/// The shares of the texels, row by row: `parts` numbers per texel that sum to one. Shares of texels without weight are
/// arbitrary. `points` are width * height stereographic points. Equal arguments give equal shares at any number of
/// threads. Errors: std::logic_error if the sizes do not match.
[[nodiscard]] std::vector<float> partition(std::span<const PlanePoint> points, int width, int height,
                                           const PartitionSettings& settings, const Progress& progress);

}  // namespace footprint::cells
