// Directions of the upper hemisphere on a square grid of cells of equal solid angle (Shirley and Chiu 1997).
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

namespace footprint {

/// Maps the unit square to the upper hemisphere: the concentric map to the unit disc, then radius^2 = 1 - z. Equal
/// areas map to equal solid angles ("A Low Distortion Map Between Disk and Square", Journal of Graphics Tools 2(3)).
[[nodiscard]] glm::dvec3 square_to_hemisphere(const glm::dvec2& point);

/// The inverse of square_to_hemisphere, in [0, 1]^2. Vectors below the horizon map to the border.
[[nodiscard]] glm::dvec2 hemisphere_to_square(const glm::dvec3& direction);

/// The centres of side x side cells; cell (x, y) has the index y * side + x.
[[nodiscard]] std::vector<glm::dvec3> direction_grid(int side);

/// The four cells around a direction with bilinear weights; clamped outside the outermost centres. `side` is at least
/// 2.
struct GridCells {
  std::array<std::size_t, 4> cells;
  std::array<double, 4> weights;
};
[[nodiscard]] GridCells cells_around(const glm::dvec3& direction, int side);

}  // namespace footprint
