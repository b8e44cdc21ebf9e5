// Gradient noise that repeats, with its exact gradient (Perlin, "Improving Noise", 2002: quintic interpolation).
#pragma once

#include <glm/glm.hpp>
#include <random>

#include "scenes/surfaces/height.hpp"
#include "scenes/surfaces/wrapped_grid.hpp"

namespace footprint {

/// Smooth noise with one hill or hollow a cell or so; values lie within about -0.7 to 0.7, their mean is 0.
class PeriodicNoise {
 public:
  /// Repeats after `period` >= 1 cells each way. The gradients at the cells' corners are drawn from `random`.
  PeriodicNoise(int period, std::mt19937_64& random);

  /// At (x, y), in cells.
  [[nodiscard]] Height at(const Height& x, const Height& y) const;

 private:
  WrappedGrid<glm::dvec2> corners_;  ///< unit gradients
};

}  // namespace footprint
