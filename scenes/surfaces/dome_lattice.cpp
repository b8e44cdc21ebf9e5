// Draws radius, offset and chance of every dome from the seed; a lookup tries the nine domes about it.
#include "scenes/surfaces/dome_lattice.hpp"

#include <algorithm>
#include <numbers>

#include "renderer/core/random.hpp"

namespace footprint {

DomeLattice::DomeLattice(int columns, double fill, double variation, std::uint32_t seed)
    : domes_(columns, 2 * std::max(1, static_cast<int>(std::lround(columns / std::numbers::sqrt3)))) {
  const double across = 1.0 / domes_.columns(), up = 1.0 / domes_.rows();
  const double room = 0.5 * std::min({across, std::hypot(0.5 * across, up), 2.0 * up});  // radius of touching discs
  std::mt19937_64 random(seed);
  for (Dome& dome : domes_) {
    dome.radius = fill * room * (1.0 - variation * uniform(random));
    const double angle = 2.0 * std::numbers::pi * uniform(random);
    dome.offset = (room - dome.radius) * uniform(random) * glm::dvec2{std::cos(angle), std::sin(angle)};
  }
  for (Dome& dome : domes_) dome.chance = uniform(random);
}

std::optional<DomePart> DomeLattice::at(const glm::dvec2& uv) const {
  const int row = static_cast<int>(uv.y * domes_.rows()), column = static_cast<int>(uv.x * domes_.columns());
  for (int y = row - 1; y <= row + 1; ++y) {
    for (int x = column - 1; x <= column + 1; ++x) {
      const Dome& dome = domes_.at(x, y);
      const double shift = y % 2 == 0 ? 0.25 : 0.75;  // of a column
      const glm::dvec2 centre{(x + shift) / domes_.columns(), (y + 0.5) / domes_.rows()};
      const glm::dvec2 offset = (uv - centre - dome.offset) / dome.radius;
      if (glm::dot(offset, offset) < 1.0) return DomePart{offset, dome.chance};
    }
  }
  return std::nullopt;
}

}  // namespace footprint
