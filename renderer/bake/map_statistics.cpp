// Sums over blocks in double precision, the mean first, because raw moments of nearly equal slopes cancel.
#include "renderer/bake/map_statistics.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "renderer/bake/slope_moments.hpp"
#include "renderer/core/error.hpp"

namespace footprint {
namespace {

struct Block {
  int count = 0;  // texels with a direction
  double resultant = 0;
  glm::dmat2 covariance{0.0};
  double fourth = 0;  // sum over both axes of the fourth central moment
};

// Calls visit(normal, x, y) for each texel with a direction in block (i, j) of 2^level texels.
template <class Visit>
void for_each_texel(const Image& normals, int level, int i, int j, Visit visit) {
  const int side = 1 << level;
  for (int y = j * side; y < std::min((j + 1) * side, normals.height); ++y) {
    for (int x = i * side; x < std::min((i + 1) * side, normals.width); ++x) {
      const auto texel = normals.at(x, y);
      if (texel[3] > 0.0F) visit(glm::normalize(glm::dvec3(texel[0], texel[1], texel[2])), x, y);
    }
  }
}

Block block_of(const Image& normals, int level, int i, int j) {
  Block block;
  glm::dvec3 sum(0.0);
  glm::dvec2 slopes(0.0);
  for_each_texel(normals, level, i, j, [&](const glm::dvec3& normal, int, int) {
    ++block.count;
    sum += normal;
    slopes += slope_of(normal);
  });
  if (block.count == 0) return block;
  block.resultant = glm::length(sum) / block.count;
  const glm::dvec2 mean = slopes / static_cast<double>(block.count);
  for_each_texel(normals, level, i, j, [&](const glm::dvec3& normal, int, int) {
    const glm::dvec2 d = slope_of(normal) - mean;
    block.covariance += glm::outerProduct(d, d) / static_cast<double>(block.count);
    block.fourth += (std::pow(d.x, 4) + std::pow(d.y, 4)) / block.count;
  });
  return block;
}

int blocks_along(int texels, int level) { return ((texels - 1) >> level) + 1; }

std::vector<Block> blocks_of(const Image& normals, int level) {
  const int columns = blocks_along(normals.width, level), rows = blocks_along(normals.height, level);
  std::vector<Block> blocks(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  tbb::parallel_for(0, rows, [&](int j) {
    for (int i = 0; i < columns; ++i)
      blocks[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(i)] =
          block_of(normals, level, i, j);
  });
  return blocks;
}

// a - b of the eigenvalues.
double eigenvalue_difference(const glm::dmat2& m) { return std::hypot(m[0][0] - m[1][1], 2.0 * m[0][1]); }

LevelStatistics statistics_at(const Image& normals, int level) {
  double count = 0, resultant = 0, trace = 0, difference = 0, fourth = 0, squares = 0;
  for (const Block& block : blocks_of(normals, level)) {
    if (block.count == 0) continue;
    const glm::dmat2& c = block.covariance;
    count += 1;
    resultant += block.resultant;
    trace += c[0][0] + c[1][1];
    difference += eigenvalue_difference(c);
    fourth += block.fourth;
    squares += c[0][0] * c[0][0] + c[1][1] * c[1][1];
  }
  LevelStatistics level_statistics{.level = level};
  if (count == 0) return level_statistics;
  level_statistics.resultant = resultant / count;
  level_statistics.variance = 0.5 * trace / count;
  if (trace > 0) level_statistics.anisotropy = difference / trace;
  constexpr double gaussian_kurtosis = 3.0;
  if (squares > 0) level_statistics.tails = fourth / (gaussian_kurtosis * squares);
  return level_statistics;
}

}  // namespace

double unit_share(const Image& stored) {
  if (stored.channels < 3 || stored.empty()) return 0.0;
  constexpr double tolerance = 0.3;  // maps of games are often not normalised
  std::size_t unit = 0;
  for (int y = 0; y < stored.height; ++y) {
    for (int x = 0; x < stored.width; ++x) {
      const auto texel = stored.at(x, y);
      const glm::dvec3 vector = 2.0 * glm::dvec3(texel[0], texel[1], texel[2]) - 1.0;
      if (vector.z > 0.0 && std::abs(glm::length(vector) - 1.0) < tolerance) ++unit;
    }
  }
  return static_cast<double>(unit) / static_cast<double>(stored.texel_count());
}

std::vector<LevelStatistics> map_statistics(const Image& normals) {
  std::vector<LevelStatistics> levels;
  for (int level = 1; (1 << level) <= std::min(normals.width, normals.height); ++level)
    levels.push_back(statistics_at(normals, level));
  return levels;
}

std::optional<double> correlation_with_spread(const Image& normals, const Image& values, int level) {
  if (values.width != normals.width || values.height != normals.height) {
    throw Error(
        ErrorKind::usage, {},
        fmt::format("is {}x{}, the normal map {}x{}", values.width, values.height, normals.width, normals.height),
        "resample one of them");
  }
  const int columns = blocks_along(normals.width, level);
  const std::vector<Block> blocks = blocks_of(normals, level);
  double count = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (blocks[b].count == 0) continue;
    double value = 0;
    for_each_texel(normals, level, static_cast<int>(b) % columns, static_cast<int>(b) / columns,
                   [&](const glm::dvec3&, int column, int row) { value += values.at(column, row)[0]; });
    value /= blocks[b].count;
    const double spread = blocks[b].covariance[0][0] + blocks[b].covariance[1][1];
    count += 1;
    x += value;
    y += spread;
    xx += value * value;
    yy += spread * spread;
    xy += value * spread;
  }
  const double variance_x = count * xx - x * x, variance_y = count * yy - y * y;
  constexpr double rounding = 1e-12;
  if (variance_x <= rounding * count * xx || variance_y <= rounding * count * yy) return {};
  return (count * xy - x * y) / std::sqrt(variance_x * variance_y);
}

}  // namespace footprint
