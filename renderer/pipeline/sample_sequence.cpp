// Digits by bit operations and hashes; the grid that divides the samples into enough passes.
#include "renderer/pipeline/sample_sequence.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstddef>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

using Mixer = std::array<std::uint16_t, 12>;

// Row r has the digits of the index whose sum is digit r of the mixed index; 1 on the diagonal and 0 below it, so that
// every aligned block of 2^m indices is only put into another order. Beyond the 12th, digits stay as they are. Found by
// search, column by column out of 96 at random: the least error, over scramblings, of the integral of random texels
// over a pixel of 1 and of 2.3 texels, drawn by the pixel's pair and this one. sample_sequence_test.cpp checks their
// gain.
constexpr Mixer unmixed{0x001, 0x002, 0x004, 0x008, 0x010, 0x020, 0x040, 0x080, 0x100, 0x200, 0x400, 0x800};
constexpr std::array<Mixer, 5> mixers{
    unmixed,
    Mixer{0xbb7, 0x86a, 0xb2c, 0x508, 0x970, 0x0a0, 0x140, 0x180, 0x900, 0xa00, 0x400, 0x800},
    Mixer{0x0b7, 0xcea, 0x52c, 0x108, 0xa70, 0xe20, 0x940, 0x680, 0xb00, 0xa00, 0x400, 0x800},
    Mixer{0x8b7, 0xd6a, 0xfac, 0x688, 0x7f0, 0xa20, 0xec0, 0xe80, 0x900, 0xe00, 0xc00, 0x800},
    Mixer{0x7b7, 0x96a, 0xa2c, 0x508, 0xd70, 0xda0, 0x840, 0x180, 0x500, 0x200, 0xc00, 0x800},
};

std::uint32_t mixed(const Mixer& mixer, std::uint32_t index) {
  std::uint32_t out = index & ~((1U << mixer.size()) - 1U);
  for (std::size_t row = 0; row < mixer.size(); ++row)
    out |= static_cast<std::uint32_t>(std::popcount(index & mixer.at(row)) & 1) << row;
  return out;
}

// Pascal's triangle modulo 2 as a matrix: digit r is the sum of the index's digits c with every bit of r set in c.
std::uint32_t pascal(std::uint32_t x) {
  x ^= (x >> 1U) & 0x55555555U;
  x ^= (x >> 2U) & 0x33333333U;
  x ^= (x >> 4U) & 0x0f0f0f0fU;
  x ^= (x >> 8U) & 0x00ff00ffU;
  x ^= x >> 16U;
  return x;
}

std::uint32_t reversed(std::uint32_t x) {
  x = ((x >> 1U) & 0x55555555U) | ((x & 0x55555555U) << 1U);
  x = ((x >> 2U) & 0x33333333U) | ((x & 0x33333333U) << 2U);
  x = ((x >> 4U) & 0x0f0f0f0fU) | ((x & 0x0f0f0f0fU) << 4U);
  x = ((x >> 8U) & 0x00ff00ffU) | ((x & 0x00ff00ffU) << 8U);
  return (x >> 16U) | (x << 16U);
}

std::uint32_t hash(std::uint32_t x) {
  x = (x ^ (x >> 16U)) * 0x7feb352dU;
  x = (x ^ (x >> 15U)) * 0x846ca68bU;
  return x ^ (x >> 16U);
}

constexpr int largest_grid = 4;  // a pass then takes 16 times an image's memory
constexpr double fixed_point_step = 0x1.0p-32;

// The largest grid that divides the samples into enough passes.
int grid_of(int spp, int fewest_passes) {
  for (int grid = largest_grid; grid > 1; --grid) {
    const int cells = grid * grid;
    if (spp % cells == 0 && spp / cells >= fewest_passes) return grid;
  }
  return 1;
}

glm::dvec2 offset_of(std::uint32_t pass, std::uint32_t seed) {
  const glm::uvec2 point = sample_digits(SamplePair::pixel, pass);
  return {scrambled(point.x, combined_seed(seed, 0)) * fixed_point_step - 0.5,
          scrambled(point.y, combined_seed(seed, 1)) * fixed_point_step - 0.5};
}

// The digits of a column or row, its first binary digit in bit 0 as in the sequence.
std::uint32_t digits_of(int grid, int place) {
  const auto p = static_cast<std::uint32_t>(place);
  return grid == 4 ? (p >> 1U) | ((p & 1U) << 1U) : p;
}

}  // namespace

glm::uvec2 sample_digits(SamplePair pair, std::uint32_t index) {
  const std::uint32_t own = mixed(mixers.at(static_cast<std::size_t>(pair)), index);
  return {own, pascal(own)};
}

std::uint32_t scrambled(std::uint32_t digits, std::uint32_t seed) {
  std::uint32_t x = digits;
  x ^= x * 0x3d20adeaU;
  x += seed;
  x *= (seed >> 16U) | 1U;
  x ^= x * 0x05526c56U;
  x ^= x * 0x53a22864U;
  return reversed(x);
}

std::uint32_t combined_seed(std::uint32_t seed, std::uint32_t with) {
  return hash(seed + 0x9e3779b9U * hash(with + 1U));
}

float unit_interval(std::uint32_t fixed_point) { return static_cast<float>(fixed_point >> 8U) * 0x1.0p-24F; }

SampleGrid sample_grid(int spp, std::uint64_t seed, int fewest_passes) {
  if (spp < 1 || spp > most_samples) {
    throw Error(ErrorKind::usage, "--spp", fmt::format("{} samples per pixel", spp),
                fmt::format("give 1 to {}", most_samples));
  }
  SampleGrid out{.grid = grid_of(spp, fewest_passes), .passes = {}};
  const int all = spp / (out.grid * out.grid);
  for (const int half : {0, 1}) {
    const int passes = half == 0 ? (all + 1) / 2 : all / 2;
    const std::uint32_t own = half_seed(seed, half);
    for (int number = 0; number < passes; ++number) {
      const auto pass = static_cast<std::uint32_t>(number);
      out.passes.push_back({.offset = offset_of(pass, own),
                            .half = half,
                            .block = 2 * number < passes ? 0 : 1,
                            .number = pass,
                            .seed = own});
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
    const glm::uvec2 point = sample_digits(SamplePair::pixel, index);
    if ((point.x & mask) == x && (point.y & mask) == y) return index;
  }
  return 0;
}

}  // namespace footprint
