// An environment's light gathered over the cells of a grid of directions.
#pragma once

#include <cstddef>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/environment.hpp"

namespace footprint {

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

/// Cells a side of a cube's faces by which an environment becomes directional lights (Iwasaki et al. 2012).
inline constexpr int dense_edge = 32;

/// A light that stands for a cell of the cube.
struct DenseLight {
  glm::vec3 direction{0.0F};   ///< towards it: through the cell's middle, unit, world
  glm::vec3 irradiance{0.0F};  ///< on a surface that faces it: the cell's radiance times solid angle
};

/// 6 x 32 x 32 lights; black ones are left out.
[[nodiscard]] std::vector<DenseLight> dense_lights(const Environment& environment);

}  // namespace footprint
