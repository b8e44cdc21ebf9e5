// Which samples a pixel has: two independently scrambled sequences, taken in passes of a grid of samples.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace footprint {

inline constexpr int most_samples = 4096;  ///< a pixel

/// Two sequences of equal length, scrambled independently of one another: the mean over each is an estimate of its own,
/// and their difference tells the error of both together (docs/metrics.md). One draw fills a grid of samples, which lie
/// in one point of their cells.
struct SamplePass {
  glm::dvec2 offset{0};      ///< from a cell's centre, in cells, -0.5 to 0.5
  int half = 0;              ///< the sequence, 0 or 1
  int block = 0;             ///< first or second part of its sequence
  std::uint32_t number = 0;  ///< of the pass in its sequence: its samples are grid^2 * number and those behind it
};

/// N = passes * grid^2 samples a pixel, in the order (half, block, number).
struct SampleGrid {
  int grid = 1;
  std::vector<SamplePass> passes;
};

inline constexpr int passes_of_halves = 4;  ///< two sequences of two blocks each: what tells a picture's noise

/// 1 <= spp <= most_samples. Deterministic for a seed; more samples of the same grid begin with the same ones. The grid
/// is the largest that leaves `fewest_passes`, where there are so many samples. Errors (usage): spp out of range.
[[nodiscard]] SampleGrid sample_grid(int spp, std::uint64_t seed, int fewest_passes = passes_of_halves);

/// What seeds everything that sequence `half` draws for a picture.
[[nodiscard]] std::uint32_t half_seed(std::uint64_t seed, int half);

/// The number of the sample of a pass that lies in `cell` (column, row) of the grid, 0 to grid^2 - 1: in the order of
/// the sequence where the grid is a power of two, so that pixel and other dimensions go together.
[[nodiscard]] std::uint32_t sample_in_cell(int grid, const glm::ivec2& cell);

}  // namespace footprint
