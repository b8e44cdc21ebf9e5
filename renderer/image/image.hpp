// An image or a map as a plain value: interleaved floats, row 0 first.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace footprint {

/// width x height texels of `channels` floats. Row 0 is the top of an image and v = 0 of a glTF texture.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<float> texels;  ///< width * height * channels, interleaved

  Image() = default;
  Image(int width_, int height_, int channels_, float value = 0.0F)
      : width(width_),
        height(height_),
        channels(channels_),
        texels(
            static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) * static_cast<std::size_t>(channels_),
            value) {}

  /// The channels of the texel in column x, row y; no bounds check.
  [[nodiscard]] std::span<float> at(int x, int y) {
    return {texels.data() + offset(x, y), static_cast<std::size_t>(channels)};
  }
  [[nodiscard]] std::span<const float> at(int x, int y) const {
    return {texels.data() + offset(x, y), static_cast<std::size_t>(channels)};
  }
  [[nodiscard]] std::size_t texel_count() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  [[nodiscard]] bool empty() const { return texels.empty(); }

  friend bool operator==(const Image&, const Image&) = default;

 private:
  [[nodiscard]] std::size_t offset(int x, int y) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
           static_cast<std::size_t>(channels);
  }
};

template <typename Value>
[[nodiscard]] Value luminance(Value red, Value green, Value blue) {
  return static_cast<Value>(0.2126) * red + static_cast<Value>(0.7152) * green + static_cast<Value>(0.0722) * blue;
}

}  // namespace footprint
