// The textures and scalars of the bin map and its inverse.
#pragma once

#include <span>
#include <string>

#include "methods/atanasov_bins/inverse_map.hpp"
#include "renderer/bake/prefiltered.hpp"

namespace footprint::atanasov_bins {

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
