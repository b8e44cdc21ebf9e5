// Directions drawn from an environment in proportion to its light: its rows, then a row's texels, by their sums.
#pragma once

#include "renderer/scene/environment.hpp"

namespace footprint {

/// Tables to draw by inversion: monotonous in the two numbers that are drawn, row by y and texel by x. Densities are
/// those of the sums as they are rounded.
struct DirectionTable {
  Image radiance;  ///< RGBA: radiance; the density over solid angle with which a direction of this texel is drawn
  /// 2 channels, one column wider than the environment: a texel's share of its row with all those before it; and, at x,
  /// the first texel whose sum exceeds x / width. The last column has the same of the rows.
  Image sums;
};

/// Texels weigh by the mean of their channels times their solid angle; a black environment is drawn from evenly.
[[nodiscard]] DirectionTable direction_table(const Image& radiance);

}  // namespace footprint
