// The reference's sample points: pairs of dimensions of a Sobol sequence, each scrambled by hashing. The shaders' twin
// is renderer/shaders/sample_sequence.glsl.
#pragma once

#include <cstdint>

namespace footprint {

/// What a pair of dimensions is drawn for. Every pair by itself is a (0, 2)-sequence in base 2: of its first 2^m
/// points, and of each further 2^m, one lies in every elementary interval of area 2^-m.
enum class SamplePair {
  pixel,   ///< where in the pixel
  texel,   ///< which texel of a map
  light,   ///< a direction out of an environment
  lobe,    ///< a direction out of the surface's lobe
  choice,  ///< among lobes: its first dimension
};

/// The two coordinates of point `index` before scrambling: binary digits, the first one in bit 0.
struct SampleDigits {
  std::uint32_t x = 0, y = 0;
};

/// Dimensions 0 and 1 of Sobol's sequence (1967) at the point that `pair` numbers `index`: each pair mixes the digits
/// of the index by a triangular matrix of its own, which keeps its elementary intervals and makes pairs differ, so that
/// they fill four dimensions together. Linear over the field of two: the digits of i ^ j are those of i and j, added
/// without carry.
[[nodiscard]] SampleDigits sample_digits(SamplePair pair, std::uint32_t index);

/// Owen's scrambling (1995) by hashing (Laine and Karras 2011; Burley 2020), with the constants of Vegdahl (2021): each
/// digit is flipped or not by a hash of those before it. Returns 32 digits, the first one in bit 31: a fixed-point
/// number in [0, 1).
[[nodiscard]] std::uint32_t scrambled(std::uint32_t digits, std::uint32_t seed);

/// A seed out of two (Wellons 2018's hash): any change of either gives an unrelated one.
[[nodiscard]] std::uint32_t combined_seed(std::uint32_t seed, std::uint32_t with);

/// From 24 of the 32 digits, as the shaders have it: exact in a float, below 1.
[[nodiscard]] float unit_interval(std::uint32_t fixed_point);

}  // namespace footprint
