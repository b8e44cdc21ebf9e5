// The bin map of a normal map and its inverse, which lists the texels of each bin. Trees count the texels under a
// footprint without visiting each (Atanasov et al. 2020, section 2.3).
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

/// The bin map of a map as Material::normal_map. Errors (usage): more than 16384 texels along an edge.
[[nodiscard]] BinMap bin_map(const Image& normals, int across, const Progress& progress);

/// Classes of texels with lobes of similar width, each with bins of a suitable width.
struct TexelClasses {
  std::vector<int> across;             ///< bins along an edge of each class
  std::vector<std::uint8_t> of_texel;  ///< row by row; empty: one class
};

/// The most texels of a leaf.
inline constexpr std::uint32_t leaf_size = 16;

/// A bin of a class as one integer; most_bins_across squared is less than 2^22.
inline constexpr unsigned bin_bits = 22;
inline constexpr std::uint32_t no_key = 0xFFFFFFFFU;
[[nodiscard]] constexpr std::uint32_t bin_key(std::size_t texel_class, std::uint32_t bin) {
  return static_cast<std::uint32_t>(texel_class) << bin_bits | bin;
}

/// The texels of one class in one bin: InverseMap::texels from `first` to the first of the next list.
struct TexelList {
  std::uint32_t key = 0;  ///< bin_key, or no_key: texels without a normal
  std::uint32_t first = 0;
  std::uint32_t root = 0;  ///< of its tree in InverseMap::forest, if it has more than leaf_size texels
};

/// A rectangle of texels, `upper` excluded.
struct TexelRect {
  glm::ivec2 lower{0};
  glm::ivec2 upper{0};
};

/// The halves of a rectangle, split in the middle of the longer side (x of a square); the lower one is smaller.
struct Halves {
  bool along_x = true;
  int middle = 0;
};
[[nodiscard]] Halves halves_of(const TexelRect& rect);

/// Nodes of at least this many texels take two integers, smaller ones one. A tree of T texels has at most T / 17 inner
/// nodes per level and at most 26 levels (most_pending in atanasov_bins_walk.glsl). Therefore a tree of less than 2^15
/// texels has fewer than 2^16 integers.
inline constexpr std::uint32_t wide_node = 1U << 15U;

/// B^-1. An inner node is stored in `forest` as the number of texels in its lower half and the number of integers in
/// that half's tree. The tree of the lower half follows directly, then that of the upper half. It takes two integers,
/// or one with the texels in its lower 16 bits (wide_node). The rectangle of the root is the map; it is halved on the
/// way down. The texels of a node are contiguous.
struct InverseMap {
  int width = 0;
  int height = 0;
  std::vector<std::uint32_t> texels;  ///< x in the lower 16 bits, y in the upper
  std::vector<TexelList> lists;       ///< ordered by key, none empty
  std::vector<std::uint32_t> forest;

  /// The number of texels of a list.
  [[nodiscard]] std::uint32_t count_of(std::size_t list) const {
    const std::size_t next = list + 1 < lists.size() ? lists[list + 1].first : texels.size();
    return static_cast<std::uint32_t>(next) - lists[list].first;
  }
  /// Whether the last list contains texels without a normal.
  [[nodiscard]] bool has_invalid() const { return !lists.empty() && lists.back().key == no_key; }
};

/// The halves of a node: their trees in `forest`, and the first texel of the upper half.
struct Branches {
  std::uint32_t lower = 0;
  std::uint32_t upper = 0;
  std::uint32_t upper_first = 0;
};
/// The halves of the inner node at `at` with the texels [first, end).
[[nodiscard]] Branches branches_of(std::span<const std::uint32_t> forest, std::uint32_t at, std::uint32_t first,
                                   std::uint32_t end);

/// The inverse of a bin map; without classes one has the map's own bins. Equal results at any number of threads.
[[nodiscard]] InverseMap invert_map(const BinMap& map, const Progress& progress, const TexelClasses& classes = {});

/// A hash table from key to list: slots of two integers, open addressing from `hash_slot`, empty ones have no_key.
[[nodiscard]] std::vector<std::uint32_t> hashed_lists(const InverseMap& map);
[[nodiscard]] std::uint32_t hash_slot(std::uint32_t key, std::uint32_t slots);

/// Mean and variance of the normals of every node within their bin, as one integer at its first. `classes` as above.
[[nodiscard]] std::vector<std::uint32_t> node_moments(const InverseMap& map, const BinMap& bins,
                                                      const TexelClasses& classes = {});

/// The mean rounding error of every list: of its normals' points (`normals`: of the map) in the unit square by 16 bits.
[[nodiscard]] std::vector<glm::vec2> list_roundings(const InverseMap& map, const BinMap& bins, const Image& normals);

/// The mean of a value over the texels of every list (one channel, as large as the map).
[[nodiscard]] std::vector<float> list_means(const InverseMap& map, const Image& values);

/// The most bins along an edge: each has 32 of the 2^16 places.
inline constexpr int most_bins_across = 2047;

/// The value of a texel without a normal; packed_normal never returns it.
inline constexpr std::uint32_t no_normal = 0xFFFFFFFFU;

/// The solid angle of each of m x m bins, 2 pi / m^2 sr.
[[nodiscard]] double bin_solid_angle(int m);

/// A unit normal's point of the unit square, 16 bits per axis (x low), rounded within its bin, or one of the rim.
[[nodiscard]] std::uint32_t packed_normal(const glm::dvec3& normal, int m);

/// The bin of a packed normal, of m x m; `m` as in packed_normal.
[[nodiscard]] std::uint32_t bin_of_packed(std::uint32_t packed, int m);

/// The point of the unit square of a packed normal, within 1e-4 radians of the normal itself.
[[nodiscard]] glm::dvec2 place_in_square(std::uint32_t packed);

/// The odd number of bins along an edge at which a bin is `share` of a lobe's standard deviation wide: 5 to `most`.
/// `variance` is the lobe's slope variance per axis.
[[nodiscard]] int bins_across_for(double variance, double share, int most);

}  // namespace footprint::atanasov_bins
