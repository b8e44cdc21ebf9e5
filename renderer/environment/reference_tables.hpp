// Environments as the reference integrates them: a table to draw directions from, or cells of directional light.
#pragma once

#include <cstddef>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/environment.hpp"

namespace footprint {

/// Tables to draw directions by inversion, row by the second number and texel by the first. Densities follow the
/// rounded sums.
struct DirectionTable {
  Image radiance;  ///< RGBA: radiance, and the density of drawn directions per solid angle
  /// 2 channels, one column wider than the environment: the cumulative share of a row up to a texel; and, at x, the
  /// first texel whose sum exceeds x / width. The last column has both for the rows.
  Image sums;
};

/// Texels are weighted by the mean of their channels times their solid angle. A black environment is drawn from
/// uniformly.
[[nodiscard]] DirectionTable direction_table(const Image& radiance);

/// A grid of directions: the number of cells, the cell of a world direction, and the fewest columns of a map with
/// several texels per cell.
struct DirectionCells {
  std::size_t count = 0;
  std::function<std::size_t(const glm::dvec3&)> cell_of;
  int fewest_columns = 0;
};

/// Radiance integrated over the solid angle of each cell. A texel counts in the cell of its middle, which preserves all
/// light. Smaller maps are subdivided first.
[[nodiscard]] std::vector<glm::dvec3> light_of_cells(const Environment& environment, const DirectionCells& cells);

/// Cells per side of a cube's faces, for environments as directional lights (Iwasaki et al. 2012).
inline constexpr int dense_edge = 32;

/// The light of a cell of the cube.
struct DenseLight {
  glm::vec3 direction{0.0F};   ///< towards the light, through the cell's middle; unit, world space
  glm::vec3 irradiance{0.0F};  ///< on a surface facing it: radiance times solid angle of the cell
};

/// 6 x 32 x 32 lights, without black ones.
[[nodiscard]] std::vector<DenseLight> dense_lights(const Environment& environment);

}  // namespace footprint
