// The maps as the textures and scalars that the shader reads.
#pragma once

#include <span>
#include <string>

#include "methods/atanasov_bins/inverse_map.hpp"
#include "renderer/bake/prefiltered.hpp"

namespace footprint::atanasov_bins {

/// Integers, four bytes each, the lowest first, in rows as long as the least power of two whose square holds them.
[[nodiscard]] PrefilteredTexture word_texture(std::string name, std::span<const std::uint32_t> words);

/// The integer at i of such a texture.
[[nodiscard]] std::uint32_t word_at(const PrefilteredTexture& texture, std::size_t i);

/// The bin map, a texel an integer, where the normal map lies.
[[nodiscard]] PrefilteredTexture bin_map_texture(const BinMap& map, const TextureCoordinates& coordinates);

/// Adds `bins_texels`, `bins_forest`, `bins_lists`, `bins_hash` and what the shader has to know of them.
void add_inverse_map(const InverseMap& map, Prefiltered& out);

/// Adds a texture of `channels` values for each list, list by list.
void add_list_values(std::string name, std::span<const float> values, int channels, Prefiltered& out);

/// Texels whose lobes are about as wide: bins along an edge, the largest slope variance that the lobe of a list may
/// have beside that of the base lobe, and the texel's own variance from which on it is of the class.
struct WidthClass {
  int across = 1;
  double widest = 0.0;
  double from = 0.0;
};

/// Adds `bins_classes`: across, widest, from.
void add_classes(std::span<const WidthClass> classes, Prefiltered& out);

}  // namespace footprint::atanasov_bins
