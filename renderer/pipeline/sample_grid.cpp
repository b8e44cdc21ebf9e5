// The grid that divides the samples into enough passes, and the jitter of each pass.
#include "renderer/pipeline/sample_grid.hpp"

#include <fmt/format.h>

#include <cmath>
#include <random>

#include "renderer/core/error.hpp"
#include "renderer/core/random.hpp"

namespace footprint {
namespace {

constexpr int most_samples = 4096;
constexpr int largest_grid = 4;   // a pass then takes 16 times a picture's memory
constexpr int fewest_passes = 4;  // for two halves that tell the noise, and for jitter

// The largest grid that divides the samples into enough passes.
int grid_of(int spp) {
  for (int grid = largest_grid; grid > 1; --grid) {
    const int cells = grid * grid;
    if (spp % cells == 0 && spp / cells >= fewest_passes) return grid;
  }
  return 1;
}

// A seeded order of 0 .. count - 1 (Fisher and Yates), again without a library's own distribution.
std::vector<int> shuffled(int count, std::mt19937_64& random) {
  std::vector<int> order(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const auto j = static_cast<std::size_t>(uniform(random) * (i + 1));
    order[static_cast<std::size_t>(i)] = order[j];
    order[j] = i;
  }
  return order;
}

// columns x rows strata for `count` points: exact where count has two near factors, else the square above it, of which
// a random choice stays empty.
glm::ivec2 strata_of(int count) {
  for (int rows = static_cast<int>(std::sqrt(count)); rows >= 1; --rows) {
    const int columns = count / rows;
    if (count % rows == 0 && columns <= 2 * rows) return {columns, rows};
  }
  const auto edge = static_cast<int>(std::ceil(std::sqrt(count)));
  return {edge, edge};
}

}  // namespace

SampleGrid sample_grid(int spp, std::uint64_t seed) {
  if (spp < 1 || spp > most_samples) {
    throw Error(ErrorKind::usage, "--spp", fmt::format("{} samples a pixel", spp),
                fmt::format("give 1 to {}", most_samples));
  }
  std::mt19937_64 random(seed);
  SampleGrid out{.grid = grid_of(spp), .offsets = {}};
  const int passes = spp / (out.grid * out.grid);
  const glm::ivec2 strata = strata_of(passes);
  const std::vector<int> order = shuffled(strata.x * strata.y, random);
  for (int pass = 0; pass < passes; ++pass) {
    const int stratum = order[static_cast<std::size_t>(pass)];
    const int column = stratum % strata.x, row = stratum / strata.x;
    const double x = (column + uniform(random)) / strata.x - 0.5;
    const double y = (row + uniform(random)) / strata.y - 0.5;
    out.offsets.emplace_back(x, y);
  }
  return out;
}

}  // namespace footprint
