// The bin map of a normal map and its inverse: for each bin the texels that are in it, so arranged that those under a
// footprint are counted without looking at each (Atanasov et al. 2020, section 2.3).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/core/progress.hpp"
#include "renderer/image/image.hpp"

namespace footprint::atanasov_bins {

/// B: the packed normal of every texel, row by row.
struct BinMap {
  int width = 0;
  int height = 0;
  int across = 1;  ///< m, bins along an edge
  std::vector<std::uint32_t> normals;
};

/// Of a normal map of four channels (as Material::normal_map). Errors (usage): more than 16384 texels along an edge.
[[nodiscard]] BinMap bin_map(const Image& normals, int across, const Progress& progress);

/// Texels whose lobes are about as wide, in bins as wide as those lobes call for.
struct TexelClasses {
  std::vector<int> across;             ///< bins along an edge, for each class
  std::vector<std::uint8_t> of_texel;  ///< row by row; empty: one class
};

/// Most texels that no tree divides.
inline constexpr std::uint32_t leaf_size = 16;

/// A bin of a class, in one integer: most_bins_across squared is less than 2^22.
inline constexpr unsigned bin_bits = 22;
inline constexpr std::uint32_t no_key = 0xFFFFFFFFU;
[[nodiscard]] constexpr std::uint32_t bin_key(std::size_t texel_class, std::uint32_t bin) {
  return static_cast<std::uint32_t>(texel_class) << bin_bits | bin;
}

/// The texels of one class in one bin, InverseMap::texels from `first` to the next list's.
struct TexelList {
  std::uint32_t key = 0;  ///< bin_key, or no_key: texels without a normal
  std::uint32_t first = 0;
  std::uint32_t root = 0;  ///< of its tree, in InverseMap::forest, where it has more than leaf_size texels
};

/// A rectangle of texels, `upper` not in it.
struct TexelRect {
  glm::ivec2 lower{0};
  glm::ivec2 upper{0};
};

/// Cut across its longer side in the middle, the lower part the smaller one; a square is cut across x.
struct Halves {
  bool along_x = true;
  int middle = 0;
};
[[nodiscard]] Halves halves_of(const TexelRect& rect);

/// Nodes of at least so many texels are two integers, smaller ones are one. No level of a tree has more than T / 17
/// nodes of the more than leaf_size texels that have an integer, T the texels of the tree, and no tree more than 26
/// levels (most_pending in atanasov_bins_walk.glsl): below 2^15 texels these are fewer than 2^16 integers.
inline constexpr std::uint32_t wide_node = 1U << 15U;

/// B^-1. A node of more than leaf_size texels stands in `forest` as the number of the texels of its lower half and the
/// number of the integers of that half's tree, which comes right behind it and has the upper half's tree behind it: two
/// integers, or one with the texels in its lower 16 bits (wide_node). The rectangle of a node is that of the map,
/// halved on the way down; its texels follow one another.
struct InverseMap {
  int width = 0;
  int height = 0;
  std::vector<std::uint32_t> texels;  ///< x in the lower 16 bits, y in the upper
  std::vector<TexelList> lists;       ///< ordered by their keys, none of them empty
  std::vector<std::uint32_t> forest;

  /// The number of texels of a list.
  [[nodiscard]] std::uint32_t count_of(std::size_t list) const {
    const std::size_t next = list + 1 < lists.size() ? lists[list + 1].first : texels.size();
    return static_cast<std::uint32_t>(next) - lists[list].first;
  }
  /// Whether the last list is that of the texels without a normal.
  [[nodiscard]] bool has_invalid() const { return !lists.empty() && lists.back().key == no_key; }
};

/// Where the halves of a node are: their trees in `forest`, and the first texel of the upper half.
struct Branches {
  std::uint32_t lower = 0;
  std::uint32_t upper = 0;
  std::uint32_t upper_first = 0;
};
/// Of the node at `at` that has the more than leaf_size texels [first, end).
[[nodiscard]] Branches branches_of(std::span<const std::uint32_t> forest, std::uint32_t at, std::uint32_t first,
                                   std::uint32_t end);

/// Equal arguments give equal values at any number of threads. Without classes: one, of the map's own bins.
[[nodiscard]] InverseMap inverse_of(const BinMap& map, const Progress& progress, const TexelClasses& classes = {});

/// From key to list: slots of two integers, key and list, by open addressing. `hash_slot` is where to begin to look; an
/// empty slot, whose key is no_key, ends the search.
[[nodiscard]] std::vector<std::uint32_t> hashed_lists(const InverseMap& map);
[[nodiscard]] std::uint32_t hash_slot(std::uint32_t key, std::uint32_t slots);

/// Normals of some texels of one bin: mean and variance of their points of the square from the bin's middle, in bins;
/// the variance is the mean of both axes'.
struct BinMoments {
  glm::dvec2 mean{0.0};
  double variance = 0.0;
};
/// In one integer: 12 bits for each coordinate of the mean, 8 for the deviation, rounded.
[[nodiscard]] std::uint32_t packed_moments(const BinMoments& moments);

/// The packed moments of every node of the forest, where its first integer is there. `classes` as for inverse_of.
[[nodiscard]] std::vector<std::uint32_t> node_moments(const InverseMap& map, const BinMap& bins,
                                                      const TexelClasses& classes = {});

/// The mean over every list of what 16 bits take from the points of its texels' normals (four channels, as large as the
/// map) in the unit square.
[[nodiscard]] std::vector<glm::vec2> list_roundings(const InverseMap& map, const BinMap& bins, const Image& normals);

/// The mean over every list of a value of its texels (one channel, as large as the map).
[[nodiscard]] std::vector<float> list_means(const InverseMap& map, const Image& values);

}  // namespace footprint::atanasov_bins
