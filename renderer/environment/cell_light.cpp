// Each texel of the environment gives its light to the cell that it lies in.
#include "renderer/environment/cell_light.hpp"

#include <algorithm>
#include <cmath>

namespace footprint {
namespace {

constexpr int dense_columns = 1024;  // a cell is 1.5 to 2.8 degrees wide, four of these columns and more

// A point of a cube's surface: face 2 axis + (0 on the positive side, else 1), u and v from -1 to 1 along the two next
// axes.
struct CubePoint {
  int face = 0;
  glm::dvec2 uv{0.0};
};

CubePoint cube_point(const glm::dvec3& d) {
  const glm::dvec3 size = glm::abs(d);
  const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
  return {2 * axis + (d[axis] < 0.0 ? 1 : 0), glm::dvec2(d[(axis + 1) % 3], d[(axis + 2) % 3]) / size[axis]};
}

glm::dvec3 cube_direction(const CubePoint& point) {
  const int axis = point.face / 2;
  glm::dvec3 d(0.0);
  d[axis] = point.face % 2 == 0 ? 1.0 : -1.0;
  d[(axis + 1) % 3] = point.uv.x;
  d[(axis + 2) % 3] = point.uv.y;
  return glm::normalize(d);
}

int cell_along(double u) { return std::clamp(static_cast<int>((0.5 + 0.5 * u) * dense_edge), 0, dense_edge - 1); }

std::size_t cube_cell(const glm::dvec3& direction) {
  const CubePoint point = cube_point(direction);
  return (static_cast<std::size_t>(point.face) * dense_edge + static_cast<std::size_t>(cell_along(point.uv.y))) *
             dense_edge +
         static_cast<std::size_t>(cell_along(point.uv.x));
}

}  // namespace

std::vector<glm::dvec3> light_of_cells(const Environment& environment, const DirectionCells& cells) {
  const auto times = [](int texels, int least) { return (least + texels - 1) / texels; };
  const Image& given = *environment.radiance;
  const Image map = resampled_environment(given, given.width * times(given.width, cells.fewest_columns),
                                          given.height * times(given.height, cells.fewest_columns / 2));
  const std::vector<double> solid_angles = row_solid_angles(map.width, map.height);
  std::vector<glm::dvec3> light(cells.count, glm::dvec3(0.0));
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const glm::dvec3 direction = environment_direction(environment, (x + 0.5) / map.width, (y + 0.5) / map.height);
      const auto texel = map.at(x, y);
      light[cells.cell_of(direction)] +=
          solid_angles[static_cast<std::size_t>(y)] * glm::dvec3(texel[0], texel[1], texel[2]);
    }
  }
  return light;
}

std::vector<DenseLight> dense_lights(const Environment& environment) {
  constexpr double side = 2.0 / dense_edge;
  const std::vector<glm::dvec3> cells = light_of_cells(
      environment,
      {.count = std::size_t{6} * dense_edge * dense_edge, .cell_of = cube_cell, .fewest_columns = dense_columns});
  std::vector<DenseLight> lights;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i] == glm::dvec3(0.0)) continue;
    const int face = static_cast<int>(i / dense_edge / dense_edge);
    const glm::dvec2 middle(static_cast<double>(i % dense_edge) + 0.5,
                            static_cast<double>(i / dense_edge % dense_edge) + 0.5);
    lights.push_back({.direction = cube_direction({face, middle * side - 1.0}), .irradiance = cells[i]});
  }
  return lights;
}

}  // namespace footprint
