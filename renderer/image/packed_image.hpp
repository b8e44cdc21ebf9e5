// A lossless compact image: channels with few distinct values are stored as indices.
#pragma once

#include <cstddef>
#include <cstdint>
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

}  // namespace footprint
