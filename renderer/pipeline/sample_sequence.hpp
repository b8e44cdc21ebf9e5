// The reference's samples: pairs of dimensions of a Sobol sequence, scrambled by hashing, in passes over a grid of
// samples. renderer/shaders/sample_sequence.glsl is the GLSL version.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace footprint {

/// The use of a pair of dimensions. Each pair alone is a (0, 2)-sequence in base 2: its first 2^m points, and each
/// further 2^m points, have one point in every elementary interval of area 2^-m.
enum class SamplePair {
  pixel,   ///< the position in the pixel
  texel,   ///< the texel of a map
  light,   ///< a direction from an environment
  lobe,    ///< a direction from the surface's lobe
  choice,  ///< the lobe; uses the first dimension only
};

/// Dimensions 0 and 1 of Sobol's sequence (1967) at a point of `pair` before scrambling: binary digits, the first one
/// in bit 0. Each pair first mixes the digits of the index by its own triangular matrix. That preserves the elementary
/// intervals and decorrelates the pairs, so two of them fill four dimensions. Linear over GF(2): the digits of i ^ j
/// are those of i xor those of j.
[[nodiscard]] glm::uvec2 sample_digits(SamplePair pair, std::uint32_t index);

/// Owen's scrambling (1995) by hashing (Laine and Karras 2011; Burley 2020) with the constants of Vegdahl (2021): a
/// hash of the digits before it flips each digit. Returns 32 digits, the first one in bit 31: a fixed-point number in
/// [0, 1).
[[nodiscard]] std::uint32_t scrambled(std::uint32_t digits, std::uint32_t seed);

/// A seed from two (hash of Wellons 2018). A change of either gives an unrelated seed.
[[nodiscard]] std::uint32_t combined_seed(std::uint32_t seed, std::uint32_t with);

/// A number in [0, 1) from the first 24 of 32 digits: exact in a float, equal to the shaders'.
[[nodiscard]] float unit_interval(std::uint32_t fixed_point);

inline constexpr int most_samples = 4096;  ///< per pixel

/// One draw, which fills a grid of samples at one point of their cells. Two sequences of equal length are scrambled
/// independently, so their means are independent estimates and their difference estimates the error (metrics.md).
struct SamplePass {
  glm::dvec2 offset{0};      ///< from a cell's centre, in cells, -0.5 to 0.5
  int half = 0;              ///< the sequence, 0 or 1
  int block = 0;             ///< 0 or 1: first or second part of its sequence
  std::uint32_t number = 0;  ///< of the pass in its sequence; its samples start at grid^2 * number
  std::uint32_t seed = 0;    ///< of everything that its sequence draws: half_seed
};

/// passes * grid^2 samples per pixel, ordered by (half, block, number).
struct SampleGrid {
  int grid = 1;  ///< samples along a pixel's edge in one pass
  std::vector<SamplePass> passes;
};

inline constexpr int passes_of_halves = 4;  ///< two sequences of two blocks each, which the noise estimate needs

/// The passes of `spp` samples per pixel. Deterministic for a seed; more samples on the same grid start with the same
/// ones.
/// spp: 1 to most_samples; otherwise throws Error (usage).
/// fewest_passes: the grid is the largest that leaves at least so many passes.
[[nodiscard]] SampleGrid sample_grid(int spp, std::uint64_t seed, int fewest_passes = passes_of_halves);

/// The seed of everything that sequence `half` draws for an image.
[[nodiscard]] std::uint32_t half_seed(std::uint64_t seed, int half);

/// The number, 0 to grid^2 - 1, of a pass's sample in `cell` (column, row). On grids of a power of two it follows the
/// sequence, so that the pixel's pair and the others stay matched.
[[nodiscard]] std::uint32_t sample_in_cell(int grid, const glm::ivec2& cell);

}  // namespace footprint
