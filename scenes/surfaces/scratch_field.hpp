// Thin straight scratches scattered over a map that tiles: where the deepest of them has which slope.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scenes/surfaces/wrapped_grid.hpp"

namespace footprint {

/// What scratches there are. Lengths are in map widths.
struct ScratchSettings {
  int count = 0;
  double length = 0.0;      ///< of the longest; others from two fifths of it
  double width = 0.0;       ///< of the widest; others from half of it
  double edge_slope = 0.0;  ///< at the edge of the deepest
  double shallowest = 0.5;  ///< of the shallowest, as a share of that: 0 to 1
};

/// A groove along a line, with a parabola for its cross-section. Lengths are in map widths.
struct Scratch {
  glm::dvec2 centre, direction;  ///< unit direction
  double half_length = 0.0, half_width = 0.0;
  double depth = 0.0;  ///< at its middle line
};

/// Scratches with places, directions, sizes and depths drawn from a seed, in a grid that a texel asks few of them by.
class ScratchField {
 public:
  ScratchField(const ScratchSettings& settings, std::uint64_t seed);

  /// The gradient of the deepest scratch at `uv`, within (0, 1); 0 where there is none.
  [[nodiscard]] glm::dvec2 slope_at(const glm::dvec2& uv) const;

 private:
  static constexpr int side = 128;  ///< cells along the map's width

  void add(Scratch scratch, const glm::dvec2& shift);

  WrappedGrid<std::vector<Scratch>> cells_{side, side};  ///< the scratches that may reach each cell
};

}  // namespace footprint
