// An image at the depth that its values need: what an 8-bit file holds lies in 8 bits, and comes back to the last bit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "renderer/image/image.hpp"

namespace footprint {

/// Each channel by itself: a constant once; up to 256 different values as bytes, up to 65536 as 16 bits, which number
/// them; else the floats themselves. Nothing is rounded: bits of NaN and of -0 stay too.
class PackedImage {
 public:
  PackedImage() = default;
  explicit PackedImage(const Image& image);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] int channels() const { return static_cast<int>(channels_.size()); }

  /// The image that it was made of, bit for bit.
  [[nodiscard]] Image unpacked() const;

  /// Bytes that it takes.
  [[nodiscard]] std::size_t byte_count() const;

 private:
  struct Channel {
    std::vector<float> values;  // that the numbers stand for; of every texel where there are no numbers
    std::variant<std::monostate, std::vector<std::uint8_t>, std::vector<std::uint16_t>> numbers;
  };
  [[nodiscard]] static Channel pack(const Image& image, std::size_t channel);

  int width_ = 0, height_ = 0;
  std::vector<Channel> channels_;
};

}  // namespace footprint
