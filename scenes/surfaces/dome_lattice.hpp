// Round domes in staggered rows over a map that tiles, each a little out of place and of its own size.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "scenes/surfaces/wrapped_grid.hpp"

namespace footprint {

/// What of a dome covers a point.
struct DomePart {
  glm::dvec2 offset;  ///< from the dome's middle, as a share of its radius; shorter than 1
  double chance;      ///< of this dome alone, 0 to 1, evenly spread over the domes

  /// The unit normal there: as of a sphere whose tilt at the dome's edge has the sine `edge`, 1 a hemisphere.
  [[nodiscard]] glm::dvec3 normal(double edge) const {
    const glm::dvec2 tilt = edge * offset;
    return glm::dvec3{tilt, std::sqrt(1.0 - glm::dot(tilt, tilt))};
  }
};

/// Rows of domes over the unit square, each odd row moved by half a column.
class DomeLattice {
 public:
  /// The number of rows is even, so that the map tiles, and makes the lattice as nearly hexagonal as it can be. `fill`:
  /// radius of the largest dome as a share of that of touching ones; `variation`: how much smaller the smallest is.
  DomeLattice(int columns, double fill, double variation, std::uint32_t seed);

  /// The dome that covers `uv`, if any.
  [[nodiscard]] std::optional<DomePart> at(const glm::dvec2& uv) const;

 private:
  struct Dome {
    glm::dvec2 offset;  ///< from its point of the lattice
    double radius = 0.0;
    double chance = 0.0;
  };
  WrappedGrid<Dome> domes_;
};

}  // namespace footprint
