// Bins of normals, and the textures and scalars of the bin map and its inverse.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>

#include "methods/atanasov_bins/inverse_map.hpp"
#include "renderer/bake/prefiltered.hpp"

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

/// A texture of integers, four bytes each, the lowest first. Its rows are as long as the least power of two whose
/// square has room for all of them.
[[nodiscard]] PrefilteredTexture word_texture(std::string name, std::span<const std::uint32_t> words);

/// Integer i of such a texture.
[[nodiscard]] std::uint32_t word_at(const PrefilteredTexture& texture, std::size_t i);

/// The bin map, one integer per texel, with the coordinates of the normal map.
[[nodiscard]] PrefilteredTexture bin_map_texture(const BinMap& map, const TextureCoordinates& coordinates);

/// Adds `bins_texels`, `bins_forest`, `bins_lists`, `bins_hash` and their scalars.
void add_inverse_map(const InverseMap& map, Prefiltered& out);

/// Adds a texture of `channels` values for each list, list by list.
void add_list_values(std::string name, std::span<const float> values, int channels, Prefiltered& out);

/// A class of texels with lobes of similar width: bins along an edge, the largest slope variance of a list's lobe in
/// addition to that of the base lobe, and the least variance of its texels.
struct WidthClass {
  int across = 1;
  double widest = 0.0;
  double from = 0.0;
};

/// Adds `bins_classes`: across, widest, from.
void add_classes(std::span<const WidthClass> classes, Prefiltered& out);

}  // namespace footprint::atanasov_bins
