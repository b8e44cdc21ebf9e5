// The partition of a material's normals: which part each texel belongs to, and how much. Learned once, the same for all
// levels.
#pragma once

#include <span>
#include <vector>

#include "methods/cells/plane.hpp"
#include "renderer/core/progress.hpp"

namespace footprint::cells {

constexpr int most_parts = 8;

/// How texels are given to parts. global: by one mixture over the whole map; joint: so that blocks of every size are
/// well described by one Gaussian a part.
enum class Labels { joint, global };

struct PartitionSettings {
  int parts = 4;
  Labels labels = Labels::joint;
  double variance = 1.0 / 64.0;  ///< slope variance per axis of the base lobe: what is finer is not told apart
  int rounds = 20;               ///< of `joint`
};

/// The share of each texel in each part, texel by texel, `parts` numbers that sum to one: those of a texel without a
/// weight are of no account. `points` are stereographic, width * height of them. Equal arguments give equal shares, at
/// any number of threads. Errors: std::logic_error on sizes that do not agree.
[[nodiscard]] std::vector<float> partition(std::span<const PlanePoint> points, int width, int height,
                                           const PartitionSettings& settings, const Progress& progress);

}  // namespace footprint::cells
