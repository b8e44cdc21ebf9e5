// The texels of a map, stored at their own bit depth and decoded to 32-bit floats for use.
#pragma once

#include <compare>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "renderer/image/image.hpp"

namespace footprint {

/// A handle on constant texels, which copies share. To read many texels, call `decoded` once and free the result soon.
class MapTexels {
 public:
  using Decode = std::function<Image(const Image& stored)>;

  /// No texels.
  MapTexels() = default;
  /// Stores floats, for computed maps.
  MapTexels(std::shared_ptr<const Image> image);  // NOLINT(google-explicit-constructor): it is what such a map is
  MapTexels(const std::shared_ptr<Image>& image)  // NOLINT(google-explicit-constructor): the same
      : MapTexels(std::shared_ptr<const Image>(image)) {}

  /// Stores an image of few different values, packed (packed_image.hpp).
  [[nodiscard]] static MapTexels packed(const Image& image);
  /// Stores the packed content of a file instead of `map`; `decode` converts it to `map` at each use.
  [[nodiscard]] static MapTexels packed(const Image& map, const Image& stored, Decode decode);

  explicit operator bool() const { return content_ != nullptr; }
  [[nodiscard]] int width() const;
  [[nodiscard]] int height() const;
  [[nodiscard]] int channels() const;
  [[nodiscard]] std::size_t texel_count() const;
  /// The channels of the texel in the first column and row.
  [[nodiscard]] std::span<const float> first() const;
  /// The whole map, bit-identical at every call. Throws Error (machine): it does not fit in memory.
  [[nodiscard]] Image decoded() const;
  /// Stored bytes.
  [[nodiscard]] std::size_t byte_count() const;

  /// Whether two share their texels.
  friend bool operator==(const MapTexels& a, const MapTexels& b) { return a.identity() == b.identity(); }
  /// An arbitrary order, for sets.
  friend auto operator<=>(const MapTexels& a, const MapTexels& b) {
    return std::compare_three_way{}(a.identity(), b.identity());
  }

 private:
  struct Content;
  [[nodiscard]] const void* identity() const;

  std::shared_ptr<const Content> content_;
};

}  // namespace footprint
