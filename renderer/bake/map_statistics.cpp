// Sums over blocks in double precision, the mean first, because raw moments of nearly equal slopes cancel.
#include "renderer/bake/map_statistics.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <random>
#include <vector>

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

Block measure_block(const Image& normals, int level, int i, int j) {
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

std::vector<Block> measure_blocks(const Image& normals, int level) {
  const int columns = blocks_along(normals.width, level), rows = blocks_along(normals.height, level);
  std::vector<Block> blocks(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  tbb::parallel_for(0, rows, [&](int j) {
    for (int i = 0; i < columns; ++i)
      blocks[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(i)] =
          measure_block(normals, level, i, j);
  });
  return blocks;
}

// a - b of the eigenvalues.
double eigenvalue_difference(const glm::dmat2& m) { return std::hypot(m[0][0] - m[1][1], 2.0 * m[0][1]); }

LevelStatistics statistics_at(const Image& normals, int level) {
  double count = 0, resultant = 0, trace = 0, difference = 0, fourth = 0, squares = 0;
  for (const Block& block : measure_blocks(normals, level)) {
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

// Blocks of a level: fewer of large ones, for about as many texels.
int block_count(int level) { return std::clamp(level < 10 ? (1 << 20) >> (2 * level) : 1, 1, 1024); }

constexpr double half_vector_slopes[][2] = {{0.1255, 0.0992}, {-0.2807, 0.3898}};  // of the scenes' two lights

struct Texel {
  glm::dvec2 slope{0.0};
  double alpha = 1;
};

double ggx(const glm::dvec2& d, const glm::dmat2& alpha_squared) {
  const double q = glm::dot(d, glm::inverse(alpha_squared) * d);
  return 1.0 / (std::numbers::pi * std::sqrt(glm::determinant(alpha_squared)) * (1.0 + q) * (1.0 + q));
}

Texel texel_at(const Image& normals, const Image& alphas, int x, int y) {
  const auto normal = normals.at(x, y);
  const bool is_flat = normal[3] <= 0.0F;
  return {.slope = is_flat ? glm::dvec2(0.0) : slope_of(glm::dvec3(normal[0], normal[1], normal[2])),
          .alpha = alphas.texel_count() == 1 ? alphas.at(0, 0)[0] : alphas.at(x, y)[0]};
}

// The texels of a random block; the one in its middle comes first.
std::vector<Texel> random_block(const Image& normals, const Image& alphas, int level, std::mt19937& random) {
  const auto start = [&](int most) { return static_cast<int>(random() % (static_cast<unsigned>(most) + 1U)); };
  const int width = std::min(1 << level, normals.width), height = std::min(1 << level, normals.height);
  const int x = start(normals.width - width), y = start(normals.height - height);
  std::vector<Texel> texels{texel_at(normals, alphas, x + width / 2, y + height / 2)};
  for (int j = 0; j < height; ++j) {
    for (int i = 0; i < width; ++i) {
      if (i != width / 2 || j != height / 2) texels.push_back(texel_at(normals, alphas, x + i, y + j));
    }
  }
  return texels;
}

// The sums of a map: squared errors by lobe, and exact values.
struct Sums {
  LobeErrors squares{};
  double exact = 0;
};

void add_block(const std::vector<Texel>& texels, Sums& sums) {
  const auto count = static_cast<double>(texels.size());
  Texel mean{.slope = glm::dvec2(0.0), .alpha = 0};
  for (const Texel& texel : texels) {
    mean.slope += texel.slope / count;
    mean.alpha += texel.alpha / count;
  }
  glm::dmat2 spread(0.0);
  for (const Texel& texel : texels)
    spread += glm::outerProduct(texel.slope - mean.slope, texel.slope - mean.slope) / count;
  const glm::dmat2 base(mean.alpha * mean.alpha);
  const glm::dmat2 shapes[] = {base, base + glm::dmat2(spread[0][0] + spread[1][1]), base + 2.0 * spread};
  for (const auto& slopes : half_vector_slopes) {
    const glm::dvec2 half(slopes[0], slopes[1]);
    const auto of_texel = [&](const Texel& t) { return ggx(half - t.slope, glm::dmat2(t.alpha * t.alpha)); };
    double exact = 0;
    for (const Texel& texel : texels) exact += of_texel(texel) / count;
    LobeErrors values{of_texel(texels.front())};
    for (std::size_t i = 0; i < std::size(shapes); ++i) values.at(i + 1) = ggx(half - mean.slope, shapes[i]);
    for (std::size_t i = 0; i < values.size(); ++i) sums.squares.at(i) += std::pow(values.at(i) - exact, 2);
    sums.exact += exact;
  }
}

void require_size(const Image& map, const Image& normals) {
  if (map.width == normals.width && map.height == normals.height) return;
  throw Error(ErrorKind::usage, {},
              fmt::format("is {}x{}, the normal map {}x{}", map.width, map.height, normals.width, normals.height),
              "resample one of them");
}

}  // namespace

double unit_share(const Image& stored) {
  if (stored.channels < 3 || stored.empty()) return 0.0;
  constexpr double tolerance = 0.3;  // maps of games are often not normalised
  std::size_t unit = 0;
  for_each_texel(stored, [&](int x, int y) {
    const auto texel = stored.at(x, y);
    const glm::dvec3 vector = 2.0 * glm::dvec3(texel[0], texel[1], texel[2]) - 1.0;
    if (vector.z > 0.0 && std::abs(glm::length(vector) - 1.0) < tolerance) ++unit;
  });
  return static_cast<double>(unit) / static_cast<double>(stored.texel_count());
}

std::vector<LevelStatistics> map_statistics(const Image& normals) {
  std::vector<LevelStatistics> levels;
  for (int level = 1; (1 << level) <= std::min(normals.width, normals.height); ++level)
    levels.push_back(statistics_at(normals, level));
  return levels;
}

std::optional<double> correlation_with_spread(const Image& normals, const Image& values, int level) {
  require_size(values, normals);
  const int columns = blocks_along(normals.width, level);
  const std::vector<Block> blocks = measure_blocks(normals, level);
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

LobeErrors lobe_errors(const Image& normals, const Image& alphas, int level) {
  if (alphas.texel_count() != 1) require_size(alphas, normals);
  std::mt19937 random(1);
  Sums sums;
  const int blocks = block_count(level);
  for (int i = 0; i < blocks; ++i) add_block(random_block(normals, alphas, level, random), sums);
  const auto samples = static_cast<double>(blocks) * static_cast<double>(std::size(half_vector_slopes));
  LobeErrors errors{};
  for (std::size_t i = 0; i < errors.size(); ++i)
    errors.at(i) = std::sqrt(sums.squares.at(i) / samples) / (sums.exact / samples);
  return errors;
}

double mean_of(const Image& map) {
  double sum = 0;
  for (std::size_t i = 0; i < map.texel_count(); ++i) sum += map.texels[i * static_cast<std::size_t>(map.channels)];
  return sum / static_cast<double>(map.texel_count());
}

}  // namespace footprint
