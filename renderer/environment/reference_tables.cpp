// Cumulative sums of texels by row and column, and radiance summed over the cells of a cube's faces.
#include "renderer/environment/reference_tables.hpp"

#include <algorithm>
#include <numeric>
#include <span>

namespace footprint {
namespace {

// The share of each texel of all light.
std::vector<double> shares_of(const Image& radiance, const std::vector<double>& solid_angles) {
  std::vector<double> weight(radiance.texel_count());
  const auto width = static_cast<std::size_t>(radiance.width);
  const auto fill = [&](auto light) {
    for (std::size_t i = 0; i < weight.size(); ++i) weight[i] = light(i) * solid_angles[i / width];
    return std::accumulate(weight.begin(), weight.end(), 0.0);
  };
  double sum = fill([&](std::size_t i) {
    const float* const texel = &radiance.texels[3 * i];
    return (static_cast<double>(texel[0]) + texel[1] + texel[2]) / 3.0;
  });
  if (sum <= 0.0) sum = fill([](std::size_t) { return 1.0; });
  for (double& w : weight) w /= sum;
  return weight;
}

// Sums of `weights` up to and with each entry as shares of all, the last one 1; evenly where all are 0.
std::vector<float> cumulative_shares(std::span<const double> weights) {
  std::vector<float> sums;
  const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
  double sum = 0;
  for (const double weight : weights) {
    sum += all > 0.0 ? weight / all : 1.0 / static_cast<double>(weights.size());
    sums.push_back(static_cast<float>(std::min(sum, 1.0)));
  }
  sums.back() = 1.0F;
  return sums;
}

// For each of as many equal parts of 0 to 1 as there are sums: the first entry whose sum exceeds where the part begins.
std::vector<float> make_guides(std::span<const float> sums) {
  std::vector<float> guides;
  std::size_t entry = 0;
  for (std::size_t part = 0; part < sums.size(); ++part) {
    const double begin = static_cast<double>(part) / static_cast<double>(sums.size());
    while (entry + 1 < sums.size() && sums[entry] <= begin) ++entry;
    guides.push_back(static_cast<float>(entry));
  }
  return guides;
}

double share_of(std::span<const float> sums, std::size_t entry) {
  return entry == 0 ? sums[0] : static_cast<double>(sums[entry]) - sums[entry - 1];
}

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

DirectionTable direction_table(const Image& radiance) {
  const std::vector<double> solid_angles = row_solid_angles(radiance.width, radiance.height);
  const std::vector<double> shares = shares_of(radiance, solid_angles);
  const auto width = static_cast<std::size_t>(radiance.width), height = static_cast<std::size_t>(radiance.height);
  DirectionTable table{Image(radiance.width, radiance.height, 4), Image(radiance.width + 1, radiance.height, 2)};
  std::vector<double> rows;
  for (std::size_t y = 0; y < height; ++y) {
    const std::span<const double> row = std::span(shares).subspan(y * width, width);
    rows.push_back(std::accumulate(row.begin(), row.end(), 0.0));
  }
  const auto set = [&](std::size_t x, std::size_t y, float sum, float guide) {
    table.sums.texels[2 * (y * (width + 1) + x)] = sum;
    table.sums.texels[2 * (y * (width + 1) + x) + 1] = guide;
  };
  const std::vector<float> row_sums = cumulative_shares(rows);
  const std::vector<float> row_guides = make_guides(row_sums);
  for (std::size_t y = 0; y < height; ++y) {
    set(width, y, row_sums[y], row_guides[y]);
    const std::vector<float> sums = cumulative_shares(std::span(shares).subspan(y * width, width));
    const std::vector<float> guides = make_guides(sums);
    for (std::size_t x = 0; x < width; ++x) {
      set(x, y, sums[x], guides[x]);
      float* const texel = &table.radiance.texels[4 * (y * width + x)];
      std::copy_n(&radiance.texels[3 * (y * width + x)], 3, texel);
      texel[3] = static_cast<float>(share_of(row_sums, y) * share_of(sums, x) / solid_angles[y]);
    }
  }
  return table;
}

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
