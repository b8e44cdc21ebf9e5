// An image or a map as a plain value: interleaved floats, row 0 first.
#pragma once

#include <algorithm>
#include <cmath>
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
  /// All members, for archives (renderer/core/bytes.hpp).
  friend void fields(auto& archive, Image& image) { archive(image.width, image.height, image.channels, image.texels); }

 private:
  [[nodiscard]] std::size_t offset(int x, int y) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
           static_cast<std::size_t>(channels);
  }
};

/// Calls `visit` (x, y) for each texel of an image, row by row.
template <class Visit>
void for_each_texel(const Image& image, const Visit& visit) {
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) visit(x, y);
  }
}

/// An image of the same size, whose texels are `value` until `write` (texel of `from`, its own texel) changes them.
template <class Write>
[[nodiscard]] Image mapped(const Image& from, int channels, const Write& write, float value = 0.0F) {
  Image out(from.width, from.height, channels, value);
  for_each_texel(from, [&](int x, int y) { write(from.at(x, y), out.at(x, y)); });
  return out;
}

/// The image with 0 for each value that is not finite.
[[nodiscard]] inline Image finite_part(Image image) {
  std::ranges::replace_if(
      image.texels, [](float value) { return !std::isfinite(value); }, 0.0F);
  return image;
}

template <typename Value>
[[nodiscard]] Value luminance(Value red, Value green, Value blue) {
  return static_cast<Value>(0.2126) * red + static_cast<Value>(0.7152) * green + static_cast<Value>(0.0722) * blue;
}

}  // namespace footprint
