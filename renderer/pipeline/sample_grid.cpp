// The grid that divides the samples into enough passes, and the points of each pass.
#include "renderer/pipeline/sample_grid.hpp"

#include <fmt/format.h>

#include "renderer/core/error.hpp"
#include "renderer/pipeline/sample_sequence.hpp"

namespace footprint {
namespace {

constexpr int largest_grid = 4;  // a pass then takes 16 times a picture's memory
constexpr double fixed_point = 0x1.0p-32;

// The largest grid that divides the samples into enough passes.
int grid_of(int spp, int fewest_passes) {
  for (int grid = largest_grid; grid > 1; --grid) {
    const int cells = grid * grid;
    if (spp % cells == 0 && spp / cells >= fewest_passes) return grid;
  }
  return 1;
}

glm::dvec2 offset_of(std::uint32_t pass, std::uint32_t seed) {
  const SampleDigits point = sample_digits(SamplePair::pixel, pass);
  return {scrambled(point.x, combined_seed(seed, 0)) * fixed_point - 0.5,
          scrambled(point.y, combined_seed(seed, 1)) * fixed_point - 0.5};
}

// Of a column or row: its first binary digit in bit 0, as the sequence's digits are.
std::uint32_t digits_of(int grid, int place) {
  const auto p = static_cast<std::uint32_t>(place);
  return grid == 4 ? (p >> 1U) | ((p & 1U) << 1U) : p;
}

}  // namespace

SampleGrid sample_grid(int spp, std::uint64_t seed, int fewest_passes) {
  if (spp < 1 || spp > most_samples) {
    throw Error(ErrorKind::usage, "--spp", fmt::format("{} samples per pixel", spp),
                fmt::format("give 1 to {}", most_samples));
  }
  SampleGrid out{.grid = grid_of(spp, fewest_passes), .passes = {}};
  const int all = spp / (out.grid * out.grid);
  for (const int half : {0, 1}) {
    const int passes = half == 0 ? (all + 1) / 2 : all / 2;
    for (int number = 0; number < passes; ++number) {
      const auto pass = static_cast<std::uint32_t>(number);
      out.passes.push_back({.offset = offset_of(pass, half_seed(seed, half)),
                            .half = half,
                            .block = 2 * number < passes ? 0 : 1,
                            .number = pass});
    }
  }
  return out;
}

std::uint32_t half_seed(std::uint64_t seed, int half) {
  return combined_seed(combined_seed(static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32U)),
                       static_cast<std::uint32_t>(half) + 0x100U);
}

std::uint32_t sample_in_cell(int grid, const glm::ivec2& cell) {
  if (grid != 2 && grid != 4) return static_cast<std::uint32_t>(cell.y * grid + cell.x);
  const std::uint32_t x = digits_of(grid, cell.x), y = digits_of(grid, cell.y);
  const auto cells = static_cast<std::uint32_t>(grid * grid);
  const std::uint32_t mask = static_cast<std::uint32_t>(grid) - 1U;
  for (std::uint32_t index = 0; index < cells; ++index) {
    const SampleDigits point = sample_digits(SamplePair::pixel, index);
    if ((point.x & mask) == x && (point.y & mask) == y) return index;
  }
  return 0;
}

}  // namespace footprint
