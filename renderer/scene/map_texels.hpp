// The texels of a material's map: kept at their own depth, decoded to 32-bit floats while they are used.
#pragma once

#include <compare>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "renderer/image/image.hpp"

namespace footprint {

/// A handle on texels that never change: copies share them. What reads many texels asks for `decoded` once and lets go
/// of it when done.
class MapTexels {
 public:
  using Decode = std::function<Image(const Image& stored)>;

  /// None.
  MapTexels() = default;
  /// Floats, kept as they are: of maps that are computed.
  MapTexels(std::shared_ptr<const Image> image);  // NOLINT(google-explicit-constructor): it is what such a map is
  MapTexels(const std::shared_ptr<Image>& image)  // NOLINT(google-explicit-constructor): the same
      : MapTexels(std::shared_ptr<const Image>(image)) {}

  /// An image of few different values, packed (packed_image.hpp).
  [[nodiscard]] static MapTexels packed(const Image& image);
  /// `map`, of which what a file stores is kept, packed: `decode` made the one of the other and does so again at each
  /// use.
  [[nodiscard]] static MapTexels packed(const Image& map, const Image& stored, Decode decode);

  explicit operator bool() const { return kept_ != nullptr; }
  [[nodiscard]] int width() const;
  [[nodiscard]] int height() const;
  [[nodiscard]] int channels() const;
  [[nodiscard]] std::size_t texel_count() const;
  /// The channels of the texel in the first column and row.
  [[nodiscard]] std::span<const float> first() const;
  /// The whole map, bit-identical at every call. Errors (machine): it does not fit in memory.
  [[nodiscard]] Image decoded() const;
  /// Bytes that are kept.
  [[nodiscard]] std::size_t byte_count() const;

  /// Whether two share their texels.
  friend bool operator==(const MapTexels& a, const MapTexels& b) { return a.identity() == b.identity(); }
  /// Any order, for sets.
  friend auto operator<=>(const MapTexels& a, const MapTexels& b) {
    return std::compare_three_way{}(a.identity(), b.identity());
  }

 private:
  struct Kept;
  [[nodiscard]] const void* identity() const;

  std::shared_ptr<const Kept> kept_;
};

}  // namespace footprint
