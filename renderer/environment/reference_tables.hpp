// Environments as the reference integrates them: a table to draw directions from, or cells of directional light.
#pragma once

#include <cstddef>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

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

/// A grid of directions: how many cells it has, the one that a direction of the world lies in, and the fewest columns
/// of a map that has several texels in every cell.
struct DirectionCells {
  std::size_t count = 0;
  std::function<std::size_t(const glm::dvec3&)> cell_of;
  int fewest_columns = 0;
};

/// Radiance integrated over the solid angle of each cell. Every texel counts in the cell that its middle lies in, so
/// that no light is lost; smaller maps have their texels cut up first.
[[nodiscard]] std::vector<glm::dvec3> light_of_cells(const Environment& environment, const DirectionCells& cells);

/// Cells per side of a cube's faces by which an environment becomes directional lights (Iwasaki et al. 2012).
inline constexpr int dense_edge = 32;

/// A light that stands for a cell of the cube.
struct DenseLight {
  glm::vec3 direction{0.0F};   ///< towards it: through the cell's middle, unit, world
  glm::vec3 irradiance{0.0F};  ///< on a surface that faces it: the cell's radiance times solid angle
};

/// 6 x 32 x 32 lights; black ones are left out.
[[nodiscard]] std::vector<DenseLight> dense_lights(const Environment& environment);

}  // namespace footprint
