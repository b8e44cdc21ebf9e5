// Bins of normals: m x m cells of equal solid angle over the hemisphere, row by row of the unit square to which
// renderer/microgeometry/direction_grid.hpp maps it. A normal in 32 bits stores its bin and its place in the bin.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace footprint::atanasov_bins {

/// The most bins along an edge: each has 32 of the 2^16 places.
inline constexpr int most_bins_across = 2047;

/// The value of a texel without a normal; packed_normal never returns it.
inline constexpr std::uint32_t no_normal = 0xFFFFFFFFU;

/// The solid angle of each of m x m bins, 2 pi / m^2 sr.
[[nodiscard]] double bin_solid_angle(int m);

/// A unit normal's point of the unit square, 16 bits per axis (x low), rounded within its bin. A normal below the
/// horizon is in the nearest bin of the rim.
[[nodiscard]] std::uint32_t packed_normal(const glm::dvec3& normal, int m);

/// The bin of a packed normal, of m x m; `m` as in packed_normal.
[[nodiscard]] std::uint32_t bin_of_packed(std::uint32_t packed, int m);

/// The point of the unit square of a packed normal, within 1e-4 radians of the normal itself.
[[nodiscard]] glm::dvec2 place_in_square(std::uint32_t packed);

/// The odd number of bins along an edge at which a bin is `share` of a lobe's standard deviation wide: 5 to `most`.
/// `variance` is the lobe's slope variance per axis.
[[nodiscard]] int bins_across_for(double variance, double share, int most);

}  // namespace footprint::atanasov_bins
