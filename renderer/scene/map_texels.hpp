// The texels of a map, stored at their own bit depth or packed, and decoded to 32-bit floats for use.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "renderer/image/image.hpp"

namespace footprint {

/// Stores each channel separately: a constant once; up to 256 distinct values by 8-bit indices, up to 65536 by 16-bit
/// indices; otherwise floats. Lossless, including the bits of NaN and -0.
class PackedImage {
 public:
  PackedImage() = default;
  explicit PackedImage(const Image& image);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] int channels() const { return static_cast<int>(channels_.size()); }

  /// The original image, bit for bit.
  [[nodiscard]] Image unpacked() const;

  /// Bytes in memory.
  [[nodiscard]] std::size_t byte_count() const;

 private:
  struct Channel {
    std::vector<float> values;  // indexed by `numbers`; of every texel without them
    std::variant<std::monostate, std::vector<std::uint8_t>, std::vector<std::uint16_t>> numbers;
  };
  [[nodiscard]] static Channel pack(const Image& image, std::size_t channel);

  int width_ = 0, height_ = 0;
  std::vector<Channel> channels_;
};

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

  /// Stores an image of few different values, packed.
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
