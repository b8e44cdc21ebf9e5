// Directions drawn from an environment in proportion to its light: Walker's alias method over its texels.
#pragma once

#include "renderer/scene/environment.hpp"

namespace footprint {

/// Tables of an environment's size. A texel is drawn by an equally likely entry t of the table: t itself with
/// probability `keep`, else `other`; then a point of it, uniform in solid angle.
struct DirectionTable {
  Image radiance;  ///< RGBA: radiance; the density over solid angle with which a direction of this texel is drawn
  Image alias;     ///< 2 channels: keep; other, a texel's number, row by row
};

/// Texels weigh by the mean of their channels times their solid angle; a black environment is drawn from evenly.
[[nodiscard]] DirectionTable direction_table(const Image& radiance);

}  // namespace footprint
