// Bins of normals, which are cells of equal solid angle over the hemisphere, and normals packed into 32 bits.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace footprint::atanasov_bins {

/// The most bins along an edge, which leaves 32 places of 2^16 in each.
inline constexpr int most_bins_across = 2047;

/// Marks a texel without a normal.
inline constexpr std::uint32_t no_normal = 0xFFFFFFFFU;

/// The bin of a unit vector among m x m bins of equal solid angle, row by row (direction_grid.hpp has the map).
/// Directions below the horizon are in the bin on the rim above them.
[[nodiscard]] std::uint32_t bin_of(const glm::dvec3& direction, int m);

/// The solid angle of a bin, 2 pi / m^2.
[[nodiscard]] double bin_solid_angle(int m);

/// A normal as its point of the unit square, 16 bits per axis (x low), rounded within its bin; never `no_normal`.
[[nodiscard]] std::uint32_t packed_normal(const glm::dvec3& normal, int m);

/// The bin of a packed normal.
[[nodiscard]] std::uint32_t bin_of_packed(std::uint32_t packed, int m);

/// The point of the unit square of a packed normal.
[[nodiscard]] glm::dvec2 place_in_square(std::uint32_t packed);

/// A packed normal, within 1e-4 radians; of a normal below the horizon that on the rim.
[[nodiscard]] glm::dvec3 unpacked_normal(std::uint32_t packed);

/// Bins along an edge, an odd number from 5 to `most`, so that a bin is as wide as `share` of a lobe's standard
/// deviation. `variance`: slope variance per axis.
[[nodiscard]] int bins_across_for(double variance, double share, int most);

}  // namespace footprint::atanasov_bins
