// Bins of normals: cells of equal solid angle over the hemisphere, and a normal in 32 bits, its bin and its place
// there.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace footprint::atanasov_bins {

/// The most bins along an edge: 32 places are left of 2^16 in each.
inline constexpr int most_bins_across = 2047;

/// A texel without a normal, in place of packed_normal.
inline constexpr std::uint32_t no_normal = 0xFFFFFFFFU;

/// The bin of a unit vector among m x m of equal solid angle, row by row (direction_grid.hpp has the map); a direction
/// below the horizon is in the bin on the rim that lies under it.
[[nodiscard]] std::uint32_t bin_of(const glm::dvec3& direction, int m);

/// Its solid angle, 2 pi / m^2.
[[nodiscard]] double bin_solid_angle(int m);

/// A normal as its point of the unit square, 16 bits an axis (x low), rounded within its bin; never `no_normal`.
[[nodiscard]] std::uint32_t packed_normal(const glm::dvec3& normal, int m);

/// The bin that packed_normal was given.
[[nodiscard]] std::uint32_t bin_of_packed(std::uint32_t packed, int m);

/// The point of the unit square.
[[nodiscard]] glm::dvec2 place_in_square(std::uint32_t packed);

/// The normal, within 1e-4 radians (of one below the horizon: that on the rim).
[[nodiscard]] glm::dvec3 unpacked_normal(std::uint32_t packed);

/// Bins along an edge, an odd number, so that one is as wide as `share` of a lobe's standard deviation; at least 5, at
/// most `most`. `variance`: slope variance per axis.
[[nodiscard]] int bins_across_for(double variance, double share, int most);

}  // namespace footprint::atanasov_bins
